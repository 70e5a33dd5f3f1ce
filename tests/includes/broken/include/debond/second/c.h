#pragma once
#include <debond/first/a.h>
#include <debond/second/b.h>
