# A port of vcpkg: the libraries; the program is not in it.
vcpkg_from_github(
    OUT_SOURCE_PATH SOURCE_PATH
    REPO temper-mesh/temper
    REF "v${VERSION}"
    SHA512 0
    HEAD_REF main
)

vcpkg_check_features(
    OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        io TEMPER_BUILD_IO
        lp TEMPER_BUILD_LP
        tbb TEMPER_BUILD_TBB
        errors TEMPER_BUILD_ERRORS
)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${FEATURE_OPTIONS}
        -DTEMPER_BUILD_APP=OFF
        -DCMAKE_DISABLE_FIND_PACKAGE_NetCDF=ON
        -DCMAKE_DISABLE_FIND_PACKAGE_HDF5Headers=ON
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/temper)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
