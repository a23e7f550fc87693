#!/bin/sh
# Proves that a stranger's clone passes: in a bare Debian, in an empty folder, without the caller's environment, runs
# the README's two commands.
#
#   tests/clean-machine.sh [bookworm|trixie] [FOLDER]      needs root and debootstrap; FOLDER (default: a new one in
#   /tmp) is kept
#
# The Debian has what the README asks for (make, git, a C linker) and the Rust toolchain of the caller; no cargo cache,
# no Python, no Node, no Go. What is tested is the commit that is checked out, cloned. CLEAN_CA names a file with
# certificates for machines behind a proxy that has its own.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
release=${1:-bookworm}
machine=${2:-$(mktemp -d)}
rustup=${RUSTUP_HOME:-$HOME/.rustup}
cargo=${CARGO_HOME:-$HOME/.cargo}

mkdir -p "$machine"
if ! [ -x "$machine/usr/bin/apt-get" ]; then
    echo "clean-machine: Debian $release in $machine"
    debootstrap --variant=minbase "$release" "$machine" >"$machine.log"
fi
cp /etc/resolv.conf /etc/hosts "$machine/etc/"
mkdir -p "$machine/root/.rustup/toolchains" "$machine/root/.cargo/bin"
toolchain=$(rustc --print sysroot)
toolchains=$machine/root/.rustup/toolchains
[ -d "$toolchains/$(basename "$toolchain")" ] || cp -a "$toolchain" "$toolchains/"
cp "$rustup/settings.toml" "$machine/root/.rustup/"
for proxy in rustup cargo rustc rustdoc rustfmt cargo-fmt cargo-clippy clippy-driver; do
    cp -P "$cargo/bin/$proxy" "$machine/root/.cargo/bin/"
done
certificates=""
if [ -n "${CLEAN_CA:-}" ]; then
    cp -L "$CLEAN_CA" "$machine/root/ca.crt"
    for name in SSL_CERT_FILE NODE_EXTRA_CA_CERTS PIP_CERT CARGO_HTTP_CAINFO; do
        certificates="$certificates $name=/root/ca.crt"
    done
fi

mounted() { grep -q " $machine/$1 " /proc/mounts; }
mounted proc || mount -t proc proc "$machine/proc"
mounted dev || mount --rbind /dev "$machine/dev"
finish() {
    umount -R -l "$machine/dev" "$machine/proc" 2>/dev/null || true
}
trap finish EXIT INT TERM

inside() {
    # $certificates is a list of words.
    # shellcheck disable=SC2086
    chroot "$machine" /usr/bin/env -i HOME=/root LANG=C.UTF-8 RUSTUP_AUTO_INSTALL=0 \
        PATH=/root/.cargo/bin:/usr/bin:/bin:/usr/sbin:/sbin $certificates "$@"
}

inside apt-get update -qq
inside env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends make git gcc libc6-dev >/dev/null 2>&1
rm -rf "$machine/sinew"
git clone -q "$root" "$machine/sinew"
for name in python3 node npm go protoc; do
    inside sh -c "command -v $name" && echo "clean-machine: $name is on the path"
done
commit=$(git -C "$root" rev-parse --short HEAD)
echo "clean-machine: $(inside cat /etc/debian_version), $(inside rustc --version), commit $commit"

started=$(date +%s)
inside sh -c 'cd /sinew && cargo build --release --locked' >"$machine.release.log" 2>&1 ||
    { tail -n 30 "$machine.release.log" >&2; exit 1; }
# What `cargo run --release` would print first; then the page.
serve='cd /sinew && exec timeout 5 cargo run --release --locked -- serve --listen 127.0.0.1:0'
inside sh -c "$serve" >"$machine.serve.log" 2>&1 || true
grep -q 'http://127.0.0.1:' "$machine.serve.log" || { cat "$machine.serve.log" >&2; exit 1; }
built=$(date +%s)
echo "clean-machine: cargo run --release serves after $((built - started)) s"
status=0
inside sh -c 'cd /sinew && make test' >"$machine.test.log" 2>&1 || status=$?
ended=$(date +%s)
grep -E '^(setup:|test result|make test:|=+ .*(passed|failed)|  *[0-9]+ passed)' "$machine.test.log" || true
[ "$status" = 0 ] || tail -n 60 "$machine.test.log"
echo "clean-machine: make test exit $status after $((ended - built)) s"
exit "$status"
