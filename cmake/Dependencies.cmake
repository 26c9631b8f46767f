# Debian 12 packages (scripts/install-packages.sh installs them).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(glm REQUIRED)
find_package(embree 3 REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(hwy REQUIRED)
# (Debian puts the CMake files of OpenColorIO where CMake does not look.)
pkg_check_modules(OCIO REQUIRED IMPORTED_TARGET OpenColorIO>=2)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale)
pkg_check_modules(FFTWF REQUIRED IMPORTED_TARGET fftw3f)
# The threads library of FFTW is not in its .pc file.
find_library(FFTWF_THREADS_LIBRARY fftw3f_threads REQUIRED)

# Debian's OpenImageIO names an include folder of OpenCV that does not exist.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES /usr/include
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "")

if(PROMENADE_TESTS)
  find_package(GTest REQUIRED)
endif()
if(PROMENADE_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
