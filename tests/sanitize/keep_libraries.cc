// Libraries that Open MPI loads and closes stay loaded, so that what they leak
// has a name, which leaks.txt knows.
extern "C" __attribute__((visibility("default"))) int
dlclose(void *)
{
  return 0;
}
