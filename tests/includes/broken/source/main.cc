#include <debond/second/b.h>
#include <debond/first/gone.h>
#include "a.h"
