#!/usr/bin/env bash
# Uses the packages of scripts/package.sh as a reader of README.md does, and removes them again: nothing may stay. For a bare Debian 12
# that may be spoilt, as root: in the folder that bare_debian.sh makes, or in a container (debian/Containerfile).
#   use_packages.sh PACKAGES      PACKAGES: folder with the .deb files
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: $0 PACKAGES" >&2; exit 2; }
packages=$(cd "$1" && pwd)
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
work=$(mktemp -d)

say() { printf '\n== %s (at %d s)\n' "$*" $SECONDS; }
fail() { echo "use_packages: $*" >&2; exit 1; }
quietly() { "$@" > "$work/log" 2>&1 || { tail -20 "$work/log"; fail "$*"; }; }
install() { quietly apt-get -qq -y --no-install-recommends install "$@"; }
# But for the packages themselves, and for what man keeps of any page that was read.
of_platen() { find / -xdev \( -path /proc -o -path "$packages" -o -path /var/cache/man -o -path "$0" \) -prune -o -iname '*platen*' -print | sort; }

quietly apt-get -qq update
dpkg --purge platen libplaten-dev platen-doc python3-platen > /dev/null 2>&1 || true
of_platen > "$work/before"

say "apt install ./platen_*.deb"
install "$packages"/platen_*.deb
dpkg -s platen | grep -E '^(Status|Version|Installed-Size)'

say "the first crush, without anything else"
cd "$work"
platen --version --json
platen-compress /usr/share/platen/scenes/demo_dry.prm --quiet
ls results/demo_dry
platen-report results/demo_dry | sed -n 1,3p
say "a first own result: a cube's height between smoother platens, in a scene of five lines"
cat > own.prm <<'END'
include parts/concrete.prm
subsection Specimen
  set Height = 50 mm
  set Sphere radius = 1.8 mm
end
subsection Platens
  set Friction static = 0.1
end
END
platen-compress own.prm -o own --quiet
platen-report own | sed -n 1,3p
say "done"
[ -s results/demo_dry/pictures/report.html ] || fail "no page was made"

say "the demo from /usr/share/platen"
quietly /usr/share/platen/scripts/demo.sh
tail -4 "$work/log"

say "man pages and completion"
install man-db bash-completion
for program in platen platen-pack platen-bonds platen-bar platen-compress platen-brazilian platen-calibrate platen-study platen-report; do
  [ -e "/usr/share/bash-completion/completions/$program" ] || fail "no completion for $program"
  [ -s "/usr/share/man/man1/$program.1.gz" ] || fail "no man page of $program"
  if ! man -P cat "$program" > "$work/page" 2> "$work/faults" || [ ! -s "$work/page" ] || [ -s "$work/faults" ]; then
    cat "$work/faults"
    fail "man $program"
  fi
done
bash -ic 'source /usr/share/bash-completion/bash_completion; _completion_loader platen-compress; complete -p platen-compress' 2> /dev/null

say "all four packages"
install "$packages"/*.deb
python3 -c '
import sys, platen
run = platen.Run("results/demo_dry")
print(platen.version()["version"], run.summary["strength_pa"], run.history.rows, len(platen.scenes()))
experiment = platen.Experiment("demo_dry", set={"Specimen/Sphere radius": "3 mm"}, output="python")
assert experiment.advance(strain=0.001)
assert not experiment.spheres["position"].flags.owndata
print(experiment.end())
'
ls /usr/share/doc/platen-doc/html/index.html /usr/share/platen/docs/theory.md
install cmake g++ make
cp -r /usr/share/platen/examples/crush crush
quietly cmake -S crush -B crush/build
quietly cmake --build crush/build
crush/build/crush > "$work/page"
sed -n 1,3p "$work/page"

say "removed again"
cd /
rm -rf ~/.cache/platen # packings that runs have kept: of the user, not of the packages
quietly apt-get -qq -y purge platen libplaten-dev platen-doc python3-platen
of_platen > "$work/after" # its own folder holds files of that name; they are not of the packages
sed -i "\\|^$work|d" "$work/after"
diff "$work/before" "$work/after" || fail "what is listed above has stayed"
rm -rf "$work"
echo "use_packages: installed, used and removed without a trace"
