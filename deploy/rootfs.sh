#!/bin/sh
# Puts a program with the libraries it links to, and the roots of certificates, into a folder that can be the root of a
# container: deploy/rootfs.sh PROGRAM FOLDER
set -eu

program=$1
root=$2
mkdir -p "$root/usr/local/bin" "$root/etc/ssl/certs" "$root/tmp"
chmod 1777 "$root/tmp"
cp "$program" "$root/usr/local/bin/sinew"
# Lines of ldd are `name => /path (address)` or `/path (address)`; the vdso has no path.
ldd "$program" | sed -n 's|[^/]*\(/[^ ]*\).*|\1|p' | while read -r library; do
    mkdir -p "$root$(dirname "$library")"
    cp -L "$library" "$root$library"
done
cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
