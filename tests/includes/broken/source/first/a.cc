#include <debond/second/b.h>
#include <vector>

int broken_order;
