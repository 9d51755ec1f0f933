# Sourced by harness/bench and harness/test: install what is missing, configure, build.
# Everything is quiet unless something has to be done or goes wrong.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
packages=(
  g++ cmake ninja-build
  libembree-dev libopenmesh-dev libtbb-dev libbenchmark-dev nlohmann-json3-dev libfmt-dev libcli11-dev libstb-dev
  libboost-dev libgmp-dev libmpfr-dev libgtest-dev libgmock-dev libvalijson-dev valgrind
)

# Install the Debian packages that are missing, as root or with sudo; elsewhere say what is needed.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    command -v cmake >/dev/null && command -v ninja >/dev/null && return
    echo "rayshoot: this is not Debian; install the equivalents of: ${packages[*]}" >&2
    exit 2
  fi
  local missing=() package as_root=()
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "rayshoot: neither root nor sudo; have this run once: apt-get install ${missing[*]}" >&2
      exit 2
    fi
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  { "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } \
    >/tmp/rayshoot-install.$$ 2>&1 || { cat /tmp/rayshoot-install.$$ >&2; exit 2; }
  rm -f /tmp/rayshoot-install.$$
}

# build [TARGET...]: configure the preset `release` where that was not done yet, and build the targets, or all.
build() {
  local started=$SECONDS options=()
  [ -z "${CI:-}" ] || options+=(-DRAYSHOOT_WERROR=ON)
  cd "$root" || exit 2
  if [ ! -f build/release/build.ninja ] || [ ${#options[@]} -gt 0 ]; then
    cmake --preset release "${options[@]}" >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 2; }
  fi
  local targets=()
  [ $# -eq 0 ] || targets=(--target "$@")
  # Ninja draws its own progress on a terminal; elsewhere only what goes wrong is worth a line.
  if [ -t 1 ]; then
    cmake --build --preset release "${targets[@]}" || exit 2
  else
    cmake --build --preset release "${targets[@]}" >build/build.log 2>&1 || { cat build/build.log >&2; exit 2; }
  fi
  echo "Built in $((SECONDS - started)) s"
}

mkdir -p "$root/build"
install_packages
