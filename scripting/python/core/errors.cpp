// stampede::Error as Python's exceptions.
#include <nanobind/stl/string.h>
#include <stampede/error.h>

#include "convert.h"

namespace stampede::python {
namespace {

PyObject* error_type = nullptr;            // stampede.Error, kept by the module
PyObject* catalogue_error_type = nullptr;  // stampede.CatalogueError

void raise(PyObject* type, const Error& error) {
  const nb::object instance = nb::handle(type)(nb::str(error.what()));
  instance.attr("where") = nb::cast(error.where());
  instance.attr("message") = nb::cast(error.message());
  instance.attr("hint") = nb::cast(error.hint());
  PyErr_SetObject(type, instance.ptr());
}

PyObject* new_type(nb::module_& module, const char* name, PyObject* base, const char* text) {
  const std::string full = "stampede." + std::string(name);
  nb::dict defaults;  // of an Error that Python raises itself
  for (const char* part : {"where", "message", "hint"}) defaults[part] = "";
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), text, base, defaults.ptr());
  module.attr(name) = nb::borrow(type);
  return type;
}

}  // namespace

void bind_errors(nb::module_& module) {
  error_type = new_type(module, "Error", PyExc_ValueError,
                        "Bad input. `where` is a place that a person can open, `message` what is wrong there, `hint` "
                        "how to cure it (or empty); `str` has all three.");
  catalogue_error_type =
      new_type(module, "CatalogueError", error_type, "A file that cannot be used as a catalogue of episodes.");
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const CatalogueError& error) {
      raise(catalogue_error_type, error);
    } catch (const Error& error) {
      raise(error_type, error);
    }
  });
}

}  // namespace stampede::python
