# Files that open but cannot be read, or have no end.
debond /proc/self/mem
debond /dev/zero
