# Every library the project leans on; deploy/setup installs the packages they come from.
include_guard(GLOBAL)

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Boost 1.81 REQUIRED)            # Asio and Beast, header only
find_package(nlohmann_json REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Imath REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(OpenImageIO REQUIRED)
# Debian's package names OpenCV's folder, which it does not depend on and we do not need.
get_target_property(RELUME_OIIO_INCLUDES OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER RELUME_OIIO_INCLUDES EXCLUDE REGEX "/opencv4$")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${RELUME_OIIO_INCLUDES}")
find_package(TinyGLTF REQUIRED)             # its header; see precompute/scene/gltf/tinygltf.cpp
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(hwy REQUIRED)
find_package(prometheus-cpp REQUIRED COMPONENTS core)
pkg_check_modules(glu REQUIRED IMPORTED_TARGET glu)  # its tessellator of polygons
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)
pkg_check_modules(seccomp REQUIRED IMPORTED_TARGET libseccomp)
find_package(GTest REQUIRED)
find_package(benchmark REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)  # a peer in tests/bench
find_package(rapidcheck REQUIRED)
