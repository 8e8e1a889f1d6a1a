# shellcheck shell=bash
# shellcheck disable=SC2034  # the variables are for the scripts that source this
# Sourced by the other tools. Gives them $root (top of the source tree), $cores, and the functions
#   need SECTION...         install the packages of these sections of packages.txt if any is missing
#   quietly LOG COMMAND...  run with all output into LOG; show its end only on failure, and on a
#                           terminal the progress: "building 61/120"
#   configure DIR OPTION... configure the build tree DIR (relative to $root)
#   refuse ARGUMENT...      exit 2 if there is an argument
# and answers --help with the comment at the top of the script.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cores=$(nproc)

fail() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# The comment at the top of the script that was called.
usage() {
  sed -n '/^#!/d; /^#/!q; s/^# \{0,1\}//p' "$0"
}

refuse() {
  (($#)) || return 0
  printf "%s: unknown argument '%s'\n\n%s\n" "${0##*/}" "$1" "$(usage)" >&2
  exit 2
}

# Prints the packages of the given sections, each once, one per line.
packages() {
  awk -v wanted=" $* " '{ sub(/#.*/, "") }
    /^\[/ { gsub(/[][ ]/, ""); on = index(wanted, " " $0 " "); next }
    on && NF && !seen[$1]++ { print $1 }' "$root/tools/packages.txt"
}

need() {
  local list missing apt=(env DEBIAN_FRONTEND=noninteractive apt-get -qq)
  list=$(packages "$@")
  command -v dpkg-query >/dev/null ||
    fail "not a Debian system. Install what corresponds to ${list//$'\n'/ } and use cmake."
  # shellcheck disable=SC2086  # one argument per package
  missing=$(comm -23 <(sort <<<"$list") <(
    dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' $list 2>/dev/null |
      sed -n 's/^[hi]i //p' | sort
  ) | paste -sd ' ')
  [[ $missing ]] || return 0
  if ((EUID)); then
    command -v sudo >/dev/null || fail "ask an administrator for: apt-get install $missing"
    if [[ -t 0 ]]; then apt=(sudo "${apt[@]}"); else apt=(sudo -n "${apt[@]}"); fi
  fi
  echo "Installing Debian packages: $missing" >&2
  # shellcheck disable=SC2086
  { quietly "$root/build/apt.txt" "${apt[@]}" update &&
    quietly "$root/build/apt.txt" "${apt[@]}" install -y --no-install-recommends $missing; } ||
    fail "could not install them. By hand: apt-get install $missing"
}

# Copies its input to the file LOG; on a terminal one line follows the counts of ninja and ctest.
follow() {
  local line terminal=
  [[ -t 2 ]] && terminal=1
  while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ $terminal ]] || continue
    if [[ $line =~ ^\[([0-9]+/[0-9]+)\]\  ]]; then
      printf '\r\e[Kbuilding %s ' "${BASH_REMATCH[1]}" >&2
    elif [[ $line =~ ^\ *([0-9]+/[0-9]+)\ Test\  ]]; then
      printf '\r\e[Ktesting %s ' "${BASH_REMATCH[1]}" >&2
    fi
  done >"$1"
  [[ ! $terminal ]] || printf '\r\e[K' >&2
}

quietly() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  "$@" </dev/null 2>&1 | follow "$log" && return
  tail -n 100 "$log" >&2
  echo "The whole output is in $log" >&2
  return 1
}

# Files are compiled in batches, since these trees are built as a whole.
configure() {
  local dir=$1
  shift
  cmake -S "$root" -B "$root/$dir" -G Ninja -DCMAKE_UNITY_BUILD=ON "$@"
}

# A script that sources this file without arguments passes its own arguments on.
for argument; do
  case $argument in
    -h | --help)
      usage
      exit
      ;;
  esac
done
