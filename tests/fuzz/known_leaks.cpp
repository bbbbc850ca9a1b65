// assimp 5.2 does not free the mesh of a PLY file that it refuses for want of faces, whatever the caller
// does. LeakSanitizer asks a program for the leaks that it is to pass over.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }
