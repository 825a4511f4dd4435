# How every target of the project is built: one place for warnings, sanitizers and linking.
include_guard(GLOBAL)

# Clones of one machine share what ccache holds: paths count from the root of the clone.
find_program(RELUME_CCACHE ccache)
if(RELUME_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
        CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${RELUME_CCACHE})
endif()

add_library(relume_build_flags INTERFACE)
target_include_directories(relume_build_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(relume_build_flags INTERFACE
    -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow
    $<$<BOOL:${RELUME_WARNINGS_AS_ERRORS}>:-Werror>
    # GCC 12 is often wrong about these two at -O3 (Imath's vectors, temporaries); Clang has neither.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overflow>)
# GCC 12 takes "text" + std::string for overlapping copies [GCC bug 105651].
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(relume_build_flags INTERFACE -Wno-restrict)
endif()
# The same source must give the same bits on every machine: no fused multiply-add by whim.
target_compile_options(relume_build_flags INTERFACE -ffp-contract=off)
if(RELUME_SANITIZE)
    # The vptr check opens pipes to see what memory may be read, which the sandbox of
    # relume-decode forbids.
    target_compile_options(relume_build_flags INTERFACE
        -fsanitize=${RELUME_SANITIZE} -fno-sanitize=vptr -fno-omit-frame-pointer
        -fno-sanitize-recover=all)
    target_link_options(relume_build_flags INTERFACE -fsanitize=${RELUME_SANITIZE})
endif()
if(RELUME_FUZZ)
    # Coverage of everything that a fuzz target links, so that libFuzzer sees where inputs lead.
    target_compile_options(relume_build_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
find_program(RELUME_MOLD mold)
if(RELUME_MOLD AND NOT RELUME_FUZZ)
    target_link_options(relume_build_flags INTERFACE -fuse-ld=mold)
endif()

# relume_library(NAME SOURCES … LINKS …): static library relume_NAME, alias relume::NAME.
function(relume_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
    add_library(relume_${name} STATIC ${ARG_SOURCES})
    add_library(relume::${name} ALIAS relume_${name})
    target_link_libraries(relume_${name} PUBLIC relume_build_flags ${ARG_LINKS})
endfunction()

# relume_program(FILE_NAME SOURCES … LINKS …): an executable.
function(relume_program name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE relume_build_flags ${ARG_LINKS})
    if(RELUME_SANITIZE MATCHES "thread")
        target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/sanitizers/thread_sanitizer.cpp)
        target_link_libraries(${name} PRIVATE TBB::tbb)
    endif()
endfunction()

# What the sanitizer presets build: every test program with label unit.
add_custom_target(unit_tests)

# relume_test(NAME SOURCES … LINKS … [LABELS …]): a GoogleTest program, registered with
# ctest as one test per program (its cases print by themselves). A folder may give all its
# tests a label by setting RELUME_TEST_LABELS.
function(relume_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;LABELS" ${ARGN})
    relume_program(${name} SOURCES ${ARG_SOURCES}
                   LINKS ${ARG_LINKS} GTest::gtest GTest::gtest_main)
    add_test(NAME ${name} COMMAND ${name})
    set(labels ${RELUME_TEST_LABELS} ${ARG_LABELS})
    list(REMOVE_DUPLICATES labels)
    set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT 600)
    if("unit" IN_LIST labels)
        add_dependencies(unit_tests ${name})
    endif()
endfunction()
