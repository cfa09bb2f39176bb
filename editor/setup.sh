# shellcheck shell=bash disable=SC2034
# Sourced by editor/run and tests/run: what Lueur is built from (Debian 12 packages), and how.

lueur_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$lueur_root} # what one clone has compiled serves the next

build_packages=(
    g++ cmake ninja-build ccache pkgconf
    libglm-dev libfmt-dev libeigen3-dev libtbb-dev
    libtomlplusplus-dev nlohmann-json3-dev libcli11-dev
    libembree-dev libassimp-dev zlib1g-dev libopenimageio-dev # assimp's CMake package names zlib's
    libglfw3-dev libepoxy-dev libimgui-dev libstb-dev
    libgl1-mesa-dri fonts-inter
)
test_packages=(clang-format libgtest-dev libgmock-dev xvfb xauth xdotool python3)

say() { printf '%s\n' "$*" >&2; }

# Those of the named packages that are not installed, one a line.
missing_packages() {
    local installed
    installed=" $(dpkg-query -W -f '${db:Status-Status}:${Package} ' "$@" 2>/dev/null) "
    local package
    for package in "$@"; do
        [[ $installed == *" installed:$package "* ]] || printf '%s\n' "$package"
    done
}

# Installs what is missing of the named packages and says what that is; silent when nothing is.
install_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "Lueur's scripts install Debian packages, and this machine has no apt-get. What is needed:"
        say "  $*"
        return 1
    fi
    local missing
    mapfile -t missing < <(missing_packages "$@")
    ((${#missing[@]})) || return 0

    local as_root=()
    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null; then
            say "These packages are missing, and without sudo only root can install them:"
            say "  apt-get install ${missing[*]}"
            return 1
        fi
        as_root=(sudo)
    fi
    say "Installing ${#missing[@]} Debian packages and what they depend on: ${missing[*]}"
    local log
    log=$(mktemp)
    # Old package lists may still do: only the installation must succeed.
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q update </dev/null >"$log" 2>&1
    if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install "${missing[@]}" \
        </dev/null >>"$log" 2>&1; then
        tail -n 30 "$log" >&2
        say "The packages could not be installed; apt-get's words are above."
        rm -f "$log"
        return 1
    fi
    rm -f "$log"
}

# build FOLDER TARGET [CMAKE OPTION...]: configures when the options are new, and builds. Without a terminal it says nothing that a first
# time or a mistake does not give reason for.
build() {
    local folder=$lueur_root/$1 target=$2
    shift 2
    local options="$*"
    if [[ ! -f $folder/build.ninja || ! -f $folder/configured-with || $(<"$folder/configured-with") != "$options" ]]; then
        say "Configuring and building ${folder#"$lueur_root"/}"
        mkdir -p "$folder"
        if ! cmake -S "$lueur_root" -B "$folder" -G Ninja "$@" >"$folder/configure.log" 2>&1; then
            cat "$folder/configure.log" >&2
            return 1
        fi
        printf '%s\n' "$options" >"$folder/configured-with"
    fi
    if [[ -t 2 ]]; then
        (cd "$folder" && ninja -j "$(nproc)" "$target" >&2)
    else
        ninja -C "$folder" --quiet -j "$(nproc)" "$target" | { grep -v '^ninja: no work to do' >&2 || true; }
    fi
}
