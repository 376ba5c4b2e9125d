# What both scripts of this folder share: source it after `here` is set.

fail() {
  echo "${0##*/}: $1" >&2
  exit 1
}

# What is asked of the machine before anything runs; `thread_counts` and `within` from THREADS and WITHIN.
check_machine() {
  read -ra thread_counts <<<"${THREADS:-1 2}"
  read -ra within <<<"${WITHIN:-}"
  local threads
  command -v yade >/dev/null || fail "yade is missing: apt-get install yade"
  command -v python3 >/dev/null || fail "python3 is missing: apt-get install python3"
  for threads in "${thread_counts[@]}"; do
    [ "$threads" -le "$(nproc)" ] || fail "$threads threads on $(nproc) cores would measure the scheduler; set THREADS"
  done
}

# Head of a table: title, machine, date, commit, Yade.
table_head() { # title
  local commit
  commit=$(git -C "$here" rev-parse --short HEAD 2>/dev/null || echo unknown)
  [ "$commit" = unknown ] || git -C "$here" diff --quiet HEAD || commit="$commit with changes"
  echo "# $1, measured"
  echo
  echo "Written by \`bench/peers/${0##*/}\`; bench/peers/README.md says what is the same and what is not."
  echo
  echo "- machine: $(LC_ALL=C lscpu | sed -n 's/^Model name: *//p' | head -n 1), $(nproc) cores," \
    "$(awk '/^MemTotal/ { printf "%.0f GB", $2 / 1048576 }' /proc/meminfo)," \
    "$(sed -nE 's/^PRETTY_NAME="?([^"]*)"?$/\1/p' /etc/os-release)"
  echo "- date: $(date -u +%Y-%m-%d); commit: $commit"
  echo "- Yade: $(yade --version 2>&1 </dev/null | sed -nE 's/^Yade version: *([^ ]+).*/\1/p' | head -n 1)," \
    "package $(dpkg-query -W -f '${Version}' yade 2>/dev/null || echo "not Debian's")"
}
