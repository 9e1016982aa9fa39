// stampede._core: the public C++ classes as Python sees them.
#include "convert.h"

NB_MODULE(_core, module) {
  nanobind::set_leak_warnings(false);  // a policy's function may hold its session, and lives as long as the program
  module.doc() = "The engine's classes. Use them by way of the package `stampede`.";
  module.attr("__version__") = STAMPEDE_VERSION;
  stampede::python::bind_threads(module);
  stampede::python::bind_errors(module);
  stampede::python::bind_environments(module);
  stampede::python::bind_catalogue(module);
  stampede::python::bind_sessions(module);
  stampede::python::bind_vectors(module);
}
