#!/bin/sh
# Installs what the tests of the viewer need: Chromium by apt, npm packages of package-lock.json, grpcurl. Safe to run
# again and again; does nothing when all is there. tests/setup.sh brings Node. Set SINEW_CHROMIUM to use another
# Chromium. Building the server needs none of this.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/../.." && pwd)

"$root/tests/setup.sh"
PATH=$root/.venv/bin:$PATH
if ! [ -x "${SINEW_CHROMIUM:-/usr/bin/chromium}" ]; then
    "$root/tests/apt.sh" chromium fonts-dejavu-core
fi

stamp="$here/node_modules/.lock"
if ! cmp -s "$here/package-lock.json" "$stamp"; then
    echo "setup: installing the npm packages of clients/web"
    (cd "$here" && npm ci --silent)
    cp "$here/package-lock.json" "$stamp"
fi

if ! [ -x "$root/.tools/grpcurl" ]; then
    echo "setup: installing grpcurl into .tools"
    GOBIN=$root/.tools go install github.com/fullstorydev/grpcurl/cmd/grpcurl@v1.9.3
fi
