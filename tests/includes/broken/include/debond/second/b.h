#pragma once
#include <debond/second/c.h>
