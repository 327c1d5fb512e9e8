# Fresh Debian systems to try things in, for other scripts: . test/debian.sh. Each is made once by debootstrap, kept in the
# user's cache and copied for each use. They reach the network through the proxies and the package sources of this machine.
debian_cache=${XDG_CACHE_HOME:-$HOME/.cache}/dondolo

# Can a fresh Debian be had? If not, one line says what is missing.
need_debian() {
   local needs=
   if [ "$(id -u)" != 0 ]; then
      needs=root
   elif ! command -v debootstrap >/dev/null; then
      needs='debootstrap: apt-get install debootstrap'
   elif ! unshare --mount --pid --fork true 2>/dev/null; then
      needs='a system that allows mount namespaces'
   else
      return 0
   fi
   printf 'a fresh Debian needs %s\n' "$needs" >&2
   return 1
}

# The mirror of this machine, if it runs Debian
own_mirror() {
   if [ "$(. /etc/os-release && echo "${ID:-}")" = debian ]; then
      awk '/^URIs:/ { print $2; exit } $1 == "deb" && $2 !~ /^\[/ { print $2; exit }' \
         /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null || true
   fi
}

# make_debian SUITE NAME PACKAGES: the pristine system NAME with these packages, if it is not there yet
make_debian() {
   local suite=$1 base=$debian_cache/$2 packages=$3 making mirror=()
   [ ! -d "$base" ] || return 0
   mkdir -p "$debian_cache"
   making=$(mktemp -d "$base.XXXXXX")
   printf 'making a fresh Debian %s in %s\n' "$suite" "$base" >&2
   mapfile -t mirror < <(own_mirror)
   if ! debootstrap --variant=minbase --include="$packages" "$suite" "$making" "${mirror[@]}" >"$making.log" 2>&1; then
      tail -n 20 "$making.log" >&2
      rm -rf --one-file-system "$making"
      return 1
   fi
   rm "$making.log"
   # All package sources of this machine, with their security updates, where it runs the same Debian
   if [ "$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" = "$suite" ]; then
      rm -f "$making/etc/apt/sources.list"
      cp -aL /etc/apt/sources.list.d "$making/etc/apt/"
      if [ -e /etc/apt/sources.list ]; then
         cp -L /etc/apt/sources.list "$making/etc/apt/"
      fi
   fi
   cp -aL /etc/apt/apt.conf.d "$making/etc/apt/"
   chmod 755 "$making"
   mv -T "$making" "$base"
}

# copy_debian NAME: sets root to a copy, which is removed when this shell ends. It has what a newcomer's machine has too: a
# way to reach the network.
copy_debian() {
   local file
   root=$(mktemp -d "$debian_cache/$1.run.XXXXXX")
   child=
   trap leave_debian EXIT
   trap 'exit 130' INT
   trap 'exit 143' HUP TERM
   cp -a "$debian_cache/$1/." "$root"
   for file in /etc/pip.conf /etc/ssl/certs/ca-certificates.crt /etc/resolv.conf /etc/hosts; do
      if [ -e "$file" ] && [ -d "$root${file%/*}" ]; then
         cp -L "$file" "$root$file"
      fi
   done
}

leave_debian() {
   if [ -n "$child" ]; then
      kill "$child" 2>/dev/null && wait "$child" || true
   fi
   rm -rf --one-file-system "$root"
}

# in_debian COMMAND: run a line of bash in the copy. Mounts and processes end with their namespaces, so that nothing of this
# machine is in the folder that is removed.
in_debian() {
   local environment
   mapfile -t environment < <(env | grep -Ei '^((https?|no)_proxy|ssl_cert_file|requests_ca_bundle|curl_ca_bundle|pip_(cert|default_timeout|index_url|extra_index_url))=' || true)
   # In the background, so that a signal is heard at once
   unshare --mount --pid --fork --kill-child bash -euc '
      root=$1 command=$2
      shift 2
      mount -t proc proc "$root/proc"
      mount -t sysfs -o ro sysfs "$root/sys"
      mount --rbind /dev "$root/dev"
      exec env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM=dumb \
         "$@" chroot "$root" bash -c "$command"' - "$root" "$1" "${environment[@]}" &
   child=$!
   wait "$child"
   child=
}
