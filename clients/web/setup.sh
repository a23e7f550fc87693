#!/bin/sh
# Installs what the tests of the viewer need: Node, Chromium and the npm packages of package-lock.json. Safe to run again and
# again; does nothing when all is there. Chromium and Node come from Debian; set SINEW_CHROMIUM to use another Chromium.
# Building the server needs none of this.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
chromium=${SINEW_CHROMIUM:-/usr/bin/chromium}

wanted=""
command -v node >/dev/null 2>&1 && command -v npm >/dev/null 2>&1 || wanted="$wanted nodejs npm"
[ -x "$chromium" ] || wanted="$wanted chromium fonts-dejavu-core"
if [ -n "$wanted" ]; then
    root=""
    [ "$(id -u)" = 0 ] || root="sudo"
    if ! command -v apt-get >/dev/null 2>&1 || { [ -n "$root" ] && ! command -v sudo >/dev/null 2>&1; }; then
        echo "setup: the tests of the viewer need$wanted; install them (Node 20 or newer), or set SINEW_CHROMIUM" >&2
        exit 1
    fi
    echo "setup: installing$wanted"
    # $wanted and $root are lists of words.
    # shellcheck disable=SC2086
    $root apt-get update -qq
    # shellcheck disable=SC2086
    $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $wanted >/dev/null
fi

major=$(node -p 'process.versions.node.split(".")[0]')
if [ "$major" -lt 20 ]; then
    echo "setup: Node $major is too old for the tests of the viewer; they need 20 or newer" >&2
    exit 1
fi

stamp="$here/node_modules/.lock"
if ! cmp -s "$here/package-lock.json" "$stamp"; then
    echo "setup: installing the npm packages of clients/web"
    (cd "$here" && npm ci --silent)
    cp "$here/package-lock.json" "$stamp"
fi
