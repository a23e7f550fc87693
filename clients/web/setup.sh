#!/bin/sh
# Installs what the viewer's tests need: the packages of package-lock.json, and a Chromium where there is none (Debian's, by apt). Safe to
# run again and again. Building the server needs none of this: the bundle in dist is committed.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$here"

if ! command -v npm >/dev/null 2>&1; then
    echo "setup: no npm on the path; install Node.js 20 or newer" >&2
    exit 1
fi
if ! cmp -s package-lock.json node_modules/.installed 2>/dev/null; then
    npm ci --no-audit --no-fund --loglevel=error
    cp package-lock.json node_modules/.installed
fi

browser=${SINEW_CHROMIUM:-/usr/bin/chromium}
if ! [ -x "$browser" ]; then
    echo "setup: installing chromium"
    as_root=
    [ "$(id -u)" -eq 0 ] || as_root=sudo
    $as_root apt-get update -qq
    DEBIAN_FRONTEND=noninteractive $as_root apt-get install -qq --no-install-recommends chromium >/dev/null
fi
