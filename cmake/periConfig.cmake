# SPDX-License-Identifier: MIT
# periConfig.cmake - find_package(peri) gives peri::peri, the shared library where there is one, and peri::static, the static one.
# Installed by `make install` and by CMake alike; periTargets.cmake, beside it, says where the libraries are.
include("${CMAKE_CURRENT_LIST_DIR}/periTargets.cmake")

if(NOT TARGET peri::peri AND TARGET peri::static)
  add_library(peri::peri INTERFACE IMPORTED)
  set_target_properties(peri::peri PROPERTIES INTERFACE_LINK_LIBRARIES peri::static)
endif()

# find_package(peri COMPONENTS static)
foreach(_peri_component IN LISTS peri_FIND_COMPONENTS)
  if(NOT TARGET peri::${_peri_component} AND peri_FIND_REQUIRED_${_peri_component})
    set(peri_FOUND FALSE)
    set(peri_NOT_FOUND_MESSAGE "this peri was installed without ${_peri_component}")
  endif()
endforeach()
unset(_peri_component)
