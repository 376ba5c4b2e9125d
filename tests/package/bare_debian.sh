#!/usr/bin/env bash
# A bare Debian 12 in a folder, and Platen in it as a reader of README.md has it. Needs root, debootstrap, and the mirror that this
# machine takes packages from.
#   bare_debian.sh PACKAGES FOLDER      installs the packages in PACKAGES, uses them and removes them again (use_packages.sh)
#   bare_debian.sh --source FOLDER      from source: scripts/demo.sh and scripts/test.sh of the last commit
#   bare_debian.sh --container PACKAGES FOLDER   as the first, in an image that buildah makes by debian/Containerfile
# FOLDER gets the Debian, some 4 GB; it is kept, and used again.
set -euo pipefail
usage() { echo "usage: $0 [--container] PACKAGES FOLDER | --source FOLDER" >&2; exit 2; }
way=packages
case "${1:-}" in --source | --container) way=${1#--}; shift ;; esac
[ $# -eq "$([ "$way" = source ] && echo 1 || echo 2)" ] || usage
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_folder=$(cd "$here/../.." && pwd)
[ "$way" = source ] || packages=$(cd "$1" && pwd)
folder=${*: -1}
mkdir -p "$folder"
root=$(cd "$folder" && pwd)/bookworm
mirror=$(grep -rhoE 'https?://[^ ]+/debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d 2>/dev/null | tr -d ' ' | head -1 || true)
[ -n "$mirror" ] || { echo "bare_debian: no mirror of Debian in /etc/apt" >&2; exit 2; }

inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive TERM=dumb "$@"; }

if [ ! -e "$root/.made" ]; then
  printf '\n== a bare Debian 12\n'
  rm -rf "$root"
  debootstrap --variant=minbase bookworm "$root" "$mirror" > "$root.log" 2>&1 || { tail -20 "$root.log"; exit 1; }
  echo "deb $mirror bookworm main" > "$root/etc/apt/sources.list"
  cp -rL /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
  mkdir -p "$root/usr/share/keyrings"
  cp -n /usr/share/keyrings/*.gpg "$root/usr/share/keyrings/" 2>/dev/null || true
  tar -C "$root" -cf "$root.tar" . # bare, for containers
  touch "$root/.made"
fi
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"

if [ "$way" = container ]; then
  # The image that the Containerfile begins with, from the same bare Debian: nothing is taken from a registry.
  export BUILDAH_ISOLATION=chroot STORAGE_DRIVER=vfs
  base=$(buildah from scratch)
  buildah add --quiet "$base" "$root.tar" / > /dev/null
  buildah commit --quiet --rm "$base" platen-bare-debian > /dev/null
  image=$folder/image
  rm -rf "$image"
  mkdir "$image"
  cp "$packages"/*.deb "$source_folder/debian/Containerfile" "$here/use_packages.sh" "$image/"
  buildah bud --network host --build-arg DEBIAN=localhost/platen-bare-debian --target checked -t platen-checked "$image"
  buildah bud --network host --build-arg DEBIAN=localhost/platen-bare-debian -t platen "$image"
  run=$(buildah from localhost/platen)
  buildah run --network host "$run" -- platen --version
  buildah rm "$run" > /dev/null
  exit 0
fi

# As a machine has them: ranks look for processors in sys, a shell that a test types into needs a terminal of dev/pts.
for mount in proc sys dev dev/pts; do mountpoint -q "$root/$mount" || mount --bind "/$mount" "$root/$mount"; done
trap 'umount "$root/dev/pts" "$root/dev" "$root/sys" "$root/proc" 2>/dev/null || true' EXIT

if [ "$way" = source ]; then
  rm -rf "$root/root/platen"
  git clone --quiet "$source_folder" "$root/root/platen"
  inside bash -c 'cd /root/platen && scripts/demo.sh && ls results/demo/dry/pictures/report.html && scripts/test.sh'
else
  rm -rf "$root/packages"
  mkdir "$root/packages"
  cp "$packages"/*.deb "$here/use_packages.sh" "$root/packages/"
  inside bash /packages/use_packages.sh /packages
fi
