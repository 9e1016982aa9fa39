// stampede::Error as Python's exceptions.
#include <nanobind/stl/string.h>
#include <stampede/error.h>

#include <regex>
#include <typeinfo>

#include "convert.h"

namespace stampede::python {
namespace {

PyObject* error_type = nullptr;            // stampede.Error, kept by the module
PyObject* catalogue_error_type = nullptr;  // stampede.CatalogueError

// `EpisodeRequest::set` is the argument `set=` in Python, `Session::tasks()` the method `Session.tasks()`.
std::string in_python(const std::string& text) {
  static const std::regex argument(R"(\b[A-Z]\w*(?:Request|Options|Settings|Entry)::(\w+))"),
      member(R"(\b([A-Z]\w*)::(\w))");
  if (text.find("::") == std::string::npos) return text;
  return std::regex_replace(std::regex_replace(text, argument, "$1="), member, "$1.$2");
}

// Without what a terminal would obey, and whatever its bytes are.
nb::object shown(const std::string& text) {
  std::string plain;
  for (const char one : text) {
    const auto byte = static_cast<unsigned char>(one);
    if ((byte < 0x20 && one != '\n' && one != '\t') || byte == 0x7f) {
      constexpr char kDigits[] = "0123456789abcdef";
      plain += {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
    } else {
      plain += one;
    }
  }
  return nb::steal(PyUnicode_DecodeUTF8(plain.data(), static_cast<Py_ssize_t>(plain.size()), "backslashreplace"));
}

void raise(PyObject* type, const Error& error) {
  const auto text = [](const std::string& words) { return shown(in_python(words)); };
  const nb::object instance = nb::handle(type)(text(error.what()));
  instance.attr("where") = text(error.where());
  instance.attr("message") = text(error.message());
  instance.attr("hint") = text(error.hint());
  PyErr_SetObject(type, instance.ptr());
}

void raise_cause(const Interruption& interruption) {
  try {
    std::rethrow_exception(interruption.cause);
  } catch (nb::python_error& error) {
    error.restore();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
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
    } catch (const Interruption& interruption) {
      raise_cause(interruption);
    } catch (const std::bad_cast&) {  // where nobody has said what it is of: `value_of` does
      PyErr_SetString(PyExc_TypeError, "a value is not of the type that is taken there, or does not fit");
    }
  });
}

}  // namespace stampede::python
