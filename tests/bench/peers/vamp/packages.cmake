# In the place of VAMP's cmake/FetchInitCPM.cmake where its own dependencies cannot be fetched: nanobind is the Python
# package, nigh is nearest.h, and its sorting is the standard library's.
macro(CPMAddPackage what)
  if("${what}" MATCHES "/nanobind#")
    execute_process(COMMAND "${Python_EXECUTABLE}" -m nanobind --cmake_dir OUTPUT_VARIABLE nanobind_DIR
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    find_package(nanobind CONFIG REQUIRED)
  endif()
endmacro()
set(nigh_SOURCE_DIR "${STAMPEDE_STAND_INS}")
set(pdqsort_SOURCE_DIR "${STAMPEDE_STAND_INS}/src")
