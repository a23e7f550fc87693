#!/bin/sh
# Installs what the tests need beside Rust: a Python environment in .venv. Safe to run again and again; does nothing when
# the installed set is the wanted one. Works from any directory.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
requirements="$root/tests/oracle/requirements.txt"
client="$root/clients/python"
venv="$root/.venv"
stamp="$venv/.requirements"

python=${PYTHON:-python3}
if ! command -v "$python" >/dev/null 2>&1; then
    echo "setup: no $python on the path; install Python 3.10 or newer, or set PYTHON" >&2
    exit 1
fi

wanted() { cat "$requirements" "$client/requirements-dev.txt" "$client/pyproject.toml"; }

if [ -x "$venv/bin/python" ] && wanted | cmp -s - "$stamp"; then
    exit 0
fi

if ! [ -x "$venv/bin/python" ]; then
    if ! "$python" -m venv "$venv"; then
        rm -rf "$venv"
        echo "setup: $python has no venv module with pip; on Debian: apt-get install python3-venv" >&2
        exit 1
    fi
fi

echo "setup: installing the Python packages of the tests and the package sinew into .venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    --requirement "$requirements" --requirement "$client/requirements-dev.txt"
# In place, so that tests see what is edited.
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-build-isolation --editable "$client"
wanted >"$stamp"
