#!/bin/sh
# Build time and size of this program with each store alone: sizes.sh TARGET_DIR. Both count the program around it,
# whose row is "none".
set -eu
cd "$(dirname "$0")"
target=${1:?a directory for the builds}
echo "| engine | clean build s | program bytes |"
echo "|---|---|---|"
for engine in none sqlite redb fjall; do
    rm -rf "$target"
    features=$engine
    [ "$engine" = none ] && features=""
    begun=$(date +%s)
    cargo build --release --quiet --no-default-features --features "$features" --target-dir "$target"
    echo "| $engine | $(($(date +%s) - begun)) | $(stat -c %s "$target/release/sinew-store-bench") |"
done
rm -rf "$target"
