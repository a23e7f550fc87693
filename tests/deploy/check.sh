#!/bin/sh
# Checks the files of deploy/ with the tools that read them: promtool on the rules, their tests, and the page of a
# running server; systemd-analyze on the unit, where there is one.
#
# promtool comes from Debian's package prometheus, unpacked into .tools: it needs neither root nor a service.
#
#   tests/deploy/check.sh      options by environment: SINEW_BIN (a built binary)
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
promtool=$root/.tools/promtool
if command -v promtool >/dev/null 2>&1; then
    promtool=promtool
elif ! [ -x "$promtool" ]; then
    echo "deploy: fetching promtool into .tools"
    work=$(mktemp -d)
    mkdir -p "$root/.tools"
    if ! (cd "$work" && apt-get download -qq prometheus && dpkg -x prometheus_*.deb unpacked) >"$work/log" 2>&1; then
        cat "$work/log" >&2
        echo "deploy: no promtool, and apt-get cannot download it: install the package prometheus" >&2
        exit 1
    fi
    cp "$work/unpacked/usr/bin/promtool" "$promtool"
    rm -rf "$work"
fi

"$promtool" check rules "$root/deploy/prometheus/rules.yaml"
"$promtool" test rules "$root/deploy/prometheus/rules_test.yaml"
python3 -m json.tool "$root/deploy/grafana/sinew.json" >/dev/null

binary=$("$root/tests/programs.sh")
work=$(mktemp -d)
server=
finish() {
    [ -z "$server" ] || kill "$server" 2>/dev/null || true
    rm -rf "$work"
}
trap finish EXIT INT TERM
"$binary" serve --listen 127.0.0.1:0 --log warn >"$work/out" 2>&1 &
server=$!
address=
for _ in $(seq 300); do
    address=$(sed -n 's|.*\(http://[0-9.]*:[0-9]*\).*|\1|p' "$work/out" | head -n 1)
    [ -z "$address" ] || break
    sleep 0.1
done
python3 -c 'import sys, urllib.request; sys.stdout.write(urllib.request.urlopen(sys.argv[1]).read().decode())' \
    "$address/metrics" >"$work/metrics"
"$promtool" check metrics <"$work/metrics"
echo "deploy: $(grep -c '^# TYPE' "$work/metrics") metrics of a running server are as promtool wants them"

if command -v systemd-analyze >/dev/null 2>&1; then
    # Programs and settings are looked for where the operator will put them.
    sed "s|/usr/local/bin/sinew|$binary|; s|/etc/sinew/sinew.toml|$root/deploy/config/sinew.toml|" \
        "$root/deploy/systemd/sinew.service" >"$work/sinew.service"
    systemd-analyze verify --man=no "$work/sinew.service"
    systemd-analyze security --no-pager --offline=yes --threshold=20 "$work/sinew.service" | tail -n 1
else
    echo "deploy: not checked: the systemd unit, because there is no systemd-analyze"
fi

# The image's root: a program with its libraries runs there, and nothing else is there to run.
"$root/deploy/rootfs.sh" "$binary" "$work/rootfs"
if [ "$(id -u)" = 0 ] && command -v chroot >/dev/null 2>&1; then
    chroot --userspec=65534:65534 "$work/rootfs" /usr/local/bin/sinew --version
    ! chroot "$work/rootfs" /bin/sh -c true 2>/dev/null
fi
echo "deploy: passed"
