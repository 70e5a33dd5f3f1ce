# Sourced by scripts that need a Debian of their own, with root and debootstrap, in a mount namespace of theirs: what they
# leave mounted is gone with them. MIRROR: where Debian comes from.

# make_tree RELEASE: in the directory work, as $tree, until the script ends
make_tree() {
  tree=$PWD/tree
  trap 'umount "$tree/sys" "$tree/proc" "$tree/dev" 2> /dev/null || true; rm -rf --one-file-system "$tree"' EXIT
  if ! debootstrap --variant=minbase "$1" "$tree" "${MIRROR:-http://deb.debian.org/debian}" > log 2>&1; then
    if grep -q "Failed getting release file" log; then echo "no mirror of Debian"; fi
    tail -n 5 log
    exit 1
  fi
  mount -t proc proc "$tree/proc"
  mount -t sysfs sysfs "$tree/sys" # MPI counts the processors there
}
inside() {
  chroot "$@" 2>&1 < /dev/null
}
install() {
  inside "$tree" env DEBIAN_FRONTEND=noninteractive apt-get install --quiet --yes --no-install-recommends "$@" > log ||
    { tail -n 20 log && exit 1; }
}
