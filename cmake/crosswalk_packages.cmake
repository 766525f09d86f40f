# Third-party libraries, Debian 12 packages only (cmake/debian-packages.txt).
# LCM and ODE ship no CMake config; lcm.pc would pull in glib flags that our code does not need.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(tomlplusplus 3.3 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(SUNDIALS 6.4 CONFIG REQUIRED COMPONENTS kinsol cvode nvecserial sunmatrixdense sunlinsoldense)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Threads REQUIRED)

find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp REQUIRED)
find_library(LCM_LIBRARY lcm REQUIRED)
find_program(LCM_GEN lcm-gen REQUIRED)
add_library(lcm::lcm UNKNOWN IMPORTED)
set_target_properties(lcm::lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})

find_path(ODE_INCLUDE_DIR ode/ode.h REQUIRED)
find_library(ODE_LIBRARY ode REQUIRED)
add_library(ode::ode UNKNOWN IMPORTED)
set_target_properties(ode::ode PROPERTIES IMPORTED_LOCATION ${ODE_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES ${ODE_INCLUDE_DIR})
