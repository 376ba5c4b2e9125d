#!/usr/bin/env bash
# Installs the packages of scripts/package.sh into a bare Debian 12 in a folder, uses them there as a reader of README.md does, and
# removes them again: nothing may stay. Needs root, debootstrap, and the mirror that this machine takes packages from.
#   bare_debian.sh PACKAGES FOLDER      PACKAGES: folder with the .deb files; FOLDER: gets the Debian, some 4 GB; it is kept, and used
#                                       again
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: $0 PACKAGES FOLDER" >&2; exit 2; }
packages=$(cd "$1" && pwd)
mkdir -p "$2"
root=$(cd "$2" && pwd)/bookworm
mirror=$(grep -rhoE 'https?://[^ ]+/debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d 2>/dev/null | tr -d ' ' | head -1 || true)
[ -n "$mirror" ] || { echo "bare_debian: no mirror of Debian in /etc/apt" >&2; exit 2; }

inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive TERM=dumb "$@"; }
say() { printf '\n== %s\n' "$*"; }
fail() { echo "bare_debian: $*" >&2; exit 1; }

if [ ! -e "$root/.made" ]; then
  say "a bare Debian 12"
  rm -rf "$root"
  debootstrap --variant=minbase bookworm "$root" "$mirror" > "$root.log" 2>&1 || { tail -20 "$root.log"; exit 1; }
  touch "$root/.made"
fi
echo "deb $mirror bookworm main" > "$root/etc/apt/sources.list"
cp -rL /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
mkdir -p "$root/usr/share/keyrings" "$root/packages"
cp -n /usr/share/keyrings/*.gpg "$root/usr/share/keyrings/" 2>/dev/null || true
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
rm -f "$root"/packages/*.deb
cp "$packages"/*.deb "$root/packages/"
for mount in proc dev; do mountpoint -q "$root/$mount" || mount --bind "/$mount" "$root/$mount"; done
trap 'umount "$root/proc" "$root/dev" 2>/dev/null || true' EXIT

inside apt-get -qq update
inside dpkg --purge platen libplaten-dev platen-doc python3-platen > /dev/null 2>&1 || true
# But for what man keeps of any page that was read.
of_platen() { inside find / -xdev \( -path /proc -o -path /packages -o -path /var/cache/man \) -prune -o -iname '*platen*' -print | sort; }
of_platen > "$root.before"

say "apt install ./platen_*.deb"
inside bash -c 'apt-get -qq -y --no-install-recommends install /packages/platen_*.deb > /tmp/install.log 2>&1 || { tail -20 /tmp/install.log; exit 1; }'
inside dpkg -s platen | grep -E '^(Status|Version|Installed-Size)'

say "the first crush, without anything else"
inside bash -c 'rm -rf /root/first && mkdir /root/first && cd /root/first &&
  platen --version --json && platen-compress "$(platen scenes demo_dry)" --quiet && ls results/demo_dry'
inside bash -c 'cd /root/first && platen-report results/demo_dry | head -3'
[ -s "$root/root/first/results/demo_dry/pictures/report.html" ] || fail "no page was made"

say "the demo from /usr/share/platen"
inside bash -c 'cd /root/first && /usr/share/platen/scripts/demo.sh > demo.log 2>&1 || { tail -20 demo.log; exit 1; }; tail -4 demo.log'

say "man pages and completion"
inside apt-get -qq -y --no-install-recommends install man-db bash-completion > /dev/null 2>&1
for program in platen platen-pack platen-bonds platen-bar platen-compress platen-brazilian platen-calibrate platen-study platen-report; do
  [ -e "$root/usr/share/bash-completion/completions/$program" ] || fail "no completion for $program"
  [ -s "$root/usr/share/man/man1/$program.1.gz" ] || fail "no man page of $program"
  inside bash -c "man -P cat $program > /tmp/page 2>/tmp/faults && [ -s /tmp/page ] && [ ! -s /tmp/faults ]" || fail "man $program"
done
inside bash -ic 'source /usr/share/bash-completion/bash_completion; _completion_loader platen-compress; complete -p platen-compress'

say "all four packages"
inside bash -c 'apt-get -qq -y --no-install-recommends install /packages/*.deb > /tmp/install.log 2>&1 || { tail -20 /tmp/install.log; exit 1; }'
inside python3 -c '
import platen
run = platen.Run("/root/first/results/demo_dry")
print(platen.version()["version"], run.summary["strength_pa"], run.history.rows, len(platen.scenes()))
experiment = platen.Experiment("demo_dry", set={"Specimen/Sphere radius": "3 mm"}, output="/root/first/python")
assert experiment.advance(strain=0.001)
assert not experiment.spheres["position"].flags.owndata
print(experiment.end())
'
inside bash -c 'ls /usr/share/doc/platen-doc/html/index.html /usr/share/platen/docs/theory.md'
inside bash -c 'apt-get -qq -y --no-install-recommends install cmake g++ make > /dev/null 2>&1 &&
  cp -r /usr/share/platen/examples/crush /root/first/crush && cd /root/first/crush && cmake -S . -B build > /dev/null && cmake --build build > /dev/null && build/crush | head -3'

say "removed again"
inside apt-get -qq -y purge platen libplaten-dev platen-doc python3-platen > /dev/null 2>&1
rm -rf "$root/root/first" "$root/tmp/install.log" "$root/root/.cache"
of_platen > "$root.after"
diff "$root.before" "$root.after" || fail "what is listed above has stayed"
echo "bare_debian: installed, used and removed without a trace"
