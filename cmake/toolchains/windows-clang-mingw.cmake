# Builds for 64-bit Windows on Debian: clang with the headers and libraries of mingw-w64 (package g++-mingw-w64-x86-64-posix), and
# lld. Not with mingw's own g++: on Windows it keeps vectors of 32 and 64 bytes on a stack that is aligned to 16 bytes alone, and
# loads them with instructions that then end the program (GCC bug 54412, open since 2012). clang aligns the stack of each function
# that needs it.
#
#     cmake -S . -B build/windows --toolchain cmake/toolchains/windows-clang-mingw.cmake
#
# scripts/test_windows does that, and fetches what the build needs.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(MINGW_TRIPLE x86_64-w64-mingw32)
find_program(CLANGXX NAMES clang++-14 clang++-15 clang++-16 clang++-17 clang++-18 clang++-19 clang++ REQUIRED)
find_program(CLANG NAMES clang-14 clang-15 clang-16 clang-17 clang-18 clang-19 clang REQUIRED)
set(CMAKE_C_COMPILER ${CLANG})
set(CMAKE_CXX_COMPILER ${CLANGXX})
set(CMAKE_C_COMPILER_TARGET ${MINGW_TRIPLE})
set(CMAKE_CXX_COMPILER_TARGET ${MINGW_TRIPLE})
set(CMAKE_RC_COMPILER ${MINGW_TRIPLE}-windres)

file(GLOB MINGW_GCC LIST_DIRECTORIES true /usr/lib/gcc/${MINGW_TRIPLE}/*-posix)
list(SORT MINGW_GCC COMPARE NATURAL ORDER DESCENDING)
list(GET MINGW_GCC 0 MINGW_GCC)
set(MINGW_ROOT /usr/${MINGW_TRIPLE})

# clang looks for these where other distributions have them, and falls back to the headers of the machine that builds. The C++
# library keeps thread-local data as g++ emulates it.
set(INCLUDES "-nostdlibinc")
set(CXX_INCLUDES "")
foreach(FOLDER include/c++ include/c++/${MINGW_TRIPLE} include/c++/backward)
  string(APPEND CXX_INCLUDES " -isystem ${MINGW_GCC}/${FOLDER}")
endforeach()
set(CMAKE_C_FLAGS_INIT "${INCLUDES} -isystem ${MINGW_ROOT}/include -femulated-tls")
set(CMAKE_CXX_FLAGS_INIT "${INCLUDES}${CXX_INCLUDES} -isystem ${MINGW_ROOT}/include -femulated-tls -D__USE_MINGW_ANSI_STDIO=1")
# All libraries are in the program: it runs where nothing is installed.
set(LINKING "-fuse-ld=lld -static -B${MINGW_GCC} -L${MINGW_GCC} -L${MINGW_ROOT}/lib -Qunused-arguments")
set(CMAKE_EXE_LINKER_FLAGS_INIT "${LINKING}")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "${LINKING}")
set(CMAKE_MODULE_LINKER_FLAGS_INIT "${LINKING}")
set(CMAKE_CXX_STANDARD_LIBRARIES "-Wl,--start-group -lstdc++ -lgcc -lgcc_eh -lwinpthread -lmingwex -lmsvcrt -lkernel32 -Wl,--end-group -ladvapi32 -lshell32 -luser32")

set(CMAKE_FIND_ROOT_PATH ${MINGW_ROOT} ${CLUSTERBENCH_WINDOWS_ROOT})
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CLUSTERBENCH_WINDOWS_ROOT)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
