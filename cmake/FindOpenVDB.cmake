# Debian's own FindOpenVDB needs Boost.Iostreams, which OpenVDB's package does not bring.
# Defines OpenVDB::openvdb from the header, the library, TBB and Imath.
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
find_package(TBB QUIET)
find_package(Imath QUIET)
if(OpenVDB_INCLUDE_DIR)
  file(STRINGS "${OpenVDB_INCLUDE_DIR}/openvdb/version.h" _openvdb_version
       REGEX "#define OPENVDB_LIBRARY_(MAJOR|MINOR|PATCH)_VERSION_NUMBER [0-9]+")
  list(TRANSFORM _openvdb_version REPLACE ".* ([0-9]+)$" "\\1")
  list(JOIN _openvdb_version "." OpenVDB_VERSION)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB
  REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR TBB_FOUND Imath_FOUND
  VERSION_VAR OpenVDB_VERSION)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES
    IMPORTED_LOCATION "${OpenVDB_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS OPENVDB_USE_DELAYED_LOADING
    INTERFACE_LINK_LIBRARIES "TBB::tbb;Imath::Imath")
endif()
