# What every target of the project is compiled with.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_AUTOMOC_MOC_OPTIONS --include "${CMAKE_CURRENT_LIST_DIR}/moc_prelude.hpp")

find_program(LIENA_CCACHE ccache)
if(LIENA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${LIENA_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${LIENA_CCACHE}")
endif()

# Several files at a time are compiled sooner than one by one. What a file changes is then compiled with its neighbours; so a folder in which
# somebody works is better without.
option(LIENA_UNITY_BUILD "Compile several source files at a time" OFF)
set(CMAKE_UNITY_BUILD ${LIENA_UNITY_BUILD})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

add_library(project_options INTERFACE)
target_compile_options(project_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wconversion -Wno-sign-conversion)
if(LIENA_WARNINGS_AS_ERRORS)
  target_compile_options(project_options INTERFACE -Werror)
endif()
if(LIENA_SANITIZE)
  add_compile_options(-fsanitize=${LIENA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LIENA_SANITIZE})
  # Some 300 programs of 100 MB each: it needs a quarter of GNU ld's time for them.
  find_program(LIENA_LLD ld.lld)
  if(LIENA_LLD)
    add_link_options(-fuse-ld=lld)
  endif()
endif()
