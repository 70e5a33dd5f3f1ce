// The example of doc/example: a scene built in a program, run in memory.

#include "../doc/example/torque_curve.cc"
