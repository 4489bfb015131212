#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Proves that the README's two commands work on a bare Debian 12: makes a root with nothing but git and
# ca-certificates, clones this repository's last commit into it, and there runs ./dev run and ./dev test.
#
#   tools/bare_machine.sh [--keep] [COMMAND...]     as root; needs debootstrap
#     --keep    leave the root in place and say where it is
#     COMMAND   run this in the clone instead of the two commands
# What this machine needs to reach the package registries (apt's sources and options, certificates, npm's and pip's
# settings) is copied into the root; nothing of it is in the repository.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
keep=
[ "${1:-}" != --keep ] || { keep=yes; shift; }

[ "$(id -u)" = 0 ] || { echo "bare_machine.sh: must be root, to make a root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "bare_machine.sh: apt-get install debootstrap" >&2; exit 1; }

root=$(mktemp -d "${TMPDIR:-/tmp}/bare.XXXXXX")
leave() {
    for place in dev proc sys; do
        if mountpoint -q "$root/$place"; then umount -l "$root/$place"; fi
    done
    if [ -n "$keep" ]; then echo "The root is $root"; else rm -rf --one-file-system "$root"; fi
}
trap leave EXIT

mirror=$(sed -n 's/^URIs: *\(\S*\).*/\1/p; s/^deb \(\[[^]]*\] \)\?\(\S*\) .*/\2/p' \
    /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2>/dev/null | head -n 1 || true)
echo "== A bare root"
debootstrap --variant=minbase --include=git,ca-certificates bookworm "$root" "${mirror:?no Debian mirror in /etc/apt}" \
    >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
rm -f "$root.log"
chroot "$root" dpkg-query -W -f '${Package}\n' | wc -l | sed 's/$/ packages/'

# The way to the registries, as on this machine.
for file in /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources /etc/apt/apt.conf.d/* \
    /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt /etc/npmrc /etc/pip.conf \
    ${SSL_CERT_FILE:-}; do
    [ ! -f "$file" ] || install -D -m 644 "$file" "$root$file"
done
[ ! -f "$root/etc/apt/sources.list.d/debian.sources" ] || rm -f "$root/etc/apt/sources.list"
passed=()
while IFS='=' read -r name value; do
    case $name in
        *_proxy | *_PROXY | SSL_CERT_FILE | SSL_CERT_DIR | NODE_EXTRA_CA_CERTS | PIP_CERT) passed+=("$name=$value") ;;
    esac
done < <(env)

mount -t proc proc "$root/proc"
mount -t sysfs sys "$root/sys"
mount --rbind /dev "$root/dev"

# --- the clone, and what a stranger types
git -C "$source" bundle create -q "$root/root/tamias2d.bundle" HEAD "$(git -C "$source" branch --show-current)"
inside() {
    chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "${passed[@]}" \
        bash -c "$1"
}
inside 'cd && git clone -q tamias2d.bundle tamias2d && git -C tamias2d log -1 --format="== Cloned %h: %s"'
timed() {
    local start=$SECONDS code=0
    echo "== $1"
    inside "cd ~/tamias2d && $1" </dev/null || code=$?
    echo "== $1: exit $code after $((SECONDS - start)) s"
    return $code
}
if [ $# -gt 0 ]; then
    timed "$*"
else
    timed "./dev run"
    timed "./dev test"
fi
