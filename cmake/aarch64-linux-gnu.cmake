# Cross compilation for AArch64 with Debian's g++-aarch64-linux-gnu. Libraries come from build/aarch64-root
# (scripts/fetch_aarch64_libraries); programs run under qemu-user, so that ctest works as for the host.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(etalon_root ${CMAKE_CURRENT_LIST_DIR}/../build/aarch64-root)
cmake_path(NORMAL_PATH etalon_root)
set(CMAKE_FIND_ROOT_PATH ${etalon_root} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Headers that differ between processors (gmp.h).
set(CMAKE_CXX_FLAGS_INIT "-isystem ${etalon_root}/usr/include/aarch64-linux-gnu")

# Libraries that other libraries need: for the linker and for the emulated loader.
set(etalon_library_folders ${etalon_root}/usr/lib/aarch64-linux-gnu ${etalon_root}/lib/aarch64-linux-gnu)
list(TRANSFORM etalon_library_folders PREPEND "-Wl,-rpath-link," OUTPUT_VARIABLE etalon_linker_flags)
list(JOIN etalon_linker_flags " " CMAKE_EXE_LINKER_FLAGS_INIT)
list(JOIN etalon_library_folders ":" etalon_library_path)
set(CMAKE_CROSSCOMPILING_EMULATOR
    qemu-aarch64;-L;/usr/aarch64-linux-gnu;-E;LD_LIBRARY_PATH=${etalon_library_path})
