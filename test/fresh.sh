#!/usr/bin/env bash
# The README's two commands on a fresh machine: bash test/fresh.sh [VERB...]
# Each `./run VERB` (demo and then test if none is given) runs in a Debian 12 with nothing installed but git and
# certificates, on a clone of the last commit. The pristine system is made once, kept in the user's cache and copied
# for each call. Reaches the network through the proxies and the package sources of this machine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [ $# -eq 0 ]; then
   set -- demo test
fi

skip() {
   printf 'skipped: ./run fresh needs %s\n' "$1" >&2
   exit 0
}

[ "$(id -u)" = 0 ] || skip root
command -v debootstrap >/dev/null || skip 'debootstrap: apt-get install debootstrap'
unshare --mount --pid --fork true 2>/dev/null || skip 'a system that allows mount namespaces'

suite=bookworm
base=${XDG_CACHE_HOME:-$HOME/.cache}/dondolo/$suite

# The package sources of this machine, where it runs the same Debian
own_sources() {
   [ "$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" = "$suite" ]
}

make_base() {
   local making mirror=()
   mkdir -p "$(dirname "$base")"
   making=$(mktemp -d "$base.XXXXXX")
   printf 'making a fresh Debian 12 in %s\n' "$base" >&2
   if own_sources; then
      mapfile -t mirror < <(awk '/^URIs:/ { print $2; exit } $1 == "deb" && $2 !~ /^\[/ { print $2; exit }' \
         /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null || true)
   fi
   if ! debootstrap --variant=minbase --include=git,ca-certificates "$suite" "$making" "${mirror[@]}" >"$making.log" 2>&1; then
      tail -n 20 "$making.log" >&2
      rm -rf --one-file-system "$making"
      return 1
   fi
   rm "$making.log"
   if own_sources; then
      rm -f "$making/etc/apt/sources.list"
      cp -aL /etc/apt/apt.conf.d /etc/apt/sources.list.d "$making/etc/apt/"
      if [ -e /etc/apt/sources.list ]; then
         cp -L /etc/apt/sources.list "$making/etc/apt/"
      fi
   fi
   chmod 755 "$making"
   mv -T "$making" "$base"
}

[ -d "$base" ] || make_base

# What a newcomer's machine has too: a way to reach the network
network() {
   local file
   for file in /etc/pip.conf /etc/ssl/certs/ca-certificates.crt /etc/resolv.conf /etc/hosts; do
      if [ -e "$file" ]; then
         cp -L "$file" "$root$file"
      fi
   done
}

root=$(mktemp -d "$base.run.XXXXXX")
child=
leave() {
   if [ -n "$child" ]; then
      kill "$child" 2>/dev/null && wait "$child" || true
   fi
   rm -rf --one-file-system "$root"
}
trap leave EXIT
trap 'exit 130' INT
trap 'exit 143' HUP TERM
cp -a "$base/." "$root"
network
git clone --quiet . "$root/home/dondolo"
if [ -n "$(git status --porcelain)" ]; then
   printf 'a clone of %s: changes that are not committed are not in it\n' "$(git rev-parse --short HEAD)" >&2
fi
mapfile -t environment < <(env | grep -Ei '^((https?|no)_proxy|ssl_cert_file|requests_ca_bundle|curl_ca_bundle|pip_(cert|default_timeout|index_url|extra_index_url))=' || true)

# Mounts and processes end with their namespaces, so that nothing of this machine is in the folder that is removed.
inside() {
   exec unshare --mount --pid --fork --kill-child bash -euc '
      root=$1 verb=$2
      shift 2
      mount -t proc proc "$root/proc"
      mount -t sysfs -o ro sysfs "$root/sys"
      mount --rbind /dev "$root/dev"
      exec env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM=dumb \
         "$@" chroot "$root" bash -c "cd /home/dondolo && exec ./run $verb"' - "$root" "$1" "${environment[@]}"
}

for verb; do
   printf '== ./run %s in a fresh Debian 12\n' "$verb" >&2
   # In the background, so that a signal is heard at once
   inside "$verb" &
   child=$!
   wait "$child"
   child=
   if [ "$verb" = demo ]; then
      figures=$(find "$root/home/dondolo/out" -name '*.png' | wc -l)
      printf '== %s figures\n' "$figures" >&2
      [ "$figures" -gt 0 ]
   fi
done
printf '== passed: %s\n' "$*" >&2
