#!/bin/sh
# Installs Debian packages: tests/apt.sh PACKAGE… Uses sudo where the user is not root.
set -eu

sudo=""
[ "$(id -u)" = 0 ] || sudo="sudo"
if ! command -v apt-get >/dev/null 2>&1 || { [ -n "$sudo" ] && ! command -v sudo >/dev/null 2>&1; }; then
    echo "setup: please install (there is no apt-get, or no right to use it): $*" >&2
    exit 1
fi
echo "setup: installing by apt: $*"
$sudo apt-get update -qq
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
