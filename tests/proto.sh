#!/bin/sh
# The protos against the rules of buf, and against version 1 of the API (proto/v1.binpb): what clients rely on is kept.
#
#   tests/proto.sh            checks; also that a change that breaks clients would be found
#   tests/proto.sh --freeze   writes proto/v1.binpb anew, for a release that adds to the API
#
# Needs what clients/web/setup.sh installs. Works from any directory.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
PATH=$root/.venv/bin:$root/clients/web/node_modules/.bin:$PATH
frozen=$root/proto/v1.binpb

buf lint "$root/proto"
buf breaking "$root/proto" --against "$frozen"
if [ "${1:-}" = --freeze ]; then
    # Nothing was broken: what was added since is part of the version from now on.
    buf build "$root/proto" --exclude-source-info -o "$frozen"
    exit 0
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# A change of one line of one file must be refused.
breaks() {
    what=$1 file=$2 edit=$3
    rm -rf "$scratch/proto"
    cp -R "$root/proto" "$scratch/proto"
    sed "$edit" "$root/proto/sinew/v1/$file" >"$scratch/proto/sinew/v1/$file"
    if cmp -s "$root/proto/sinew/v1/$file" "$scratch/proto/sinew/v1/$file"; then
        echo "proto: the edit for $what changes nothing" >&2
        exit 1
    fi
    if buf breaking "$scratch/proto" --against "$frozen" >"$scratch/found" 2>&1; then
        echo "proto: $what is not found to break clients" >&2
        exit 1
    fi
    # It is refused for what it does, not because it cannot be read.
    grep -Eq "$file:[0-9]+:[0-9]+:(Field|Previously present)" "$scratch/found" || {
        cat "$scratch/found" >&2
        echo "proto: $what is refused for another reason" >&2
        exit 1
    }
}
breaks "another type" world.proto 's/double rate_hz = 3/float rate_hz = 3/'
breaks "another number" figure.proto 's/double assist = 11/double assist = 21/'
breaks "another name" perturbation.proto 's/force_newtons = 3/force_n = 3/'
breaks "a call that is gone" obstacle.proto '/rpc GetObstacle/,/^  }/d'
