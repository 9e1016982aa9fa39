// Between what C++ and what Python users see: arrays, actions, answers.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <stampede/arrays.h>
#include <stampede/environment.h>
#include <stampede/rows.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "threads.h"

namespace stampede::python {

inline bool is_any(PyObject*) { return true; }

// What the reference calls numpy.ndarray.
class NumpyArray : public nb::object {
  NB_OBJECT_DEFAULT(NumpyArray, nb::object, "numpy.ndarray", is_any)
};
using NamedArrays = nb::typed<nb::dict, nb::str, NumpyArray>;
using NamedValues = nb::typed<nb::dict, nb::str, nb::any>;

// Several Python objects look at the memory of one episode.
struct SharedArrays {
  std::shared_ptr<const EpisodeArrays> arrays;
};

// A numpy array that owns the values, without a copy. Bytes that are truth values become numpy's bool.
template <typename Value, typename Shown = Value>
NumpyArray numpy_array(std::vector<Value> values, const std::vector<std::int64_t>& shape) {
  auto owned = std::make_unique<std::vector<Value>>(std::move(values));
  Value* data = owned->data();
  nb::capsule owner(owned.release(), [](void* held) noexcept { delete static_cast<std::vector<Value>*>(held); });
  const std::vector<std::size_t> sizes(shape.begin(), shape.end());
  static_assert(sizeof(Shown) == sizeof(Value));
  return nb::borrow<NumpyArray>(
      nb::cast(nb::ndarray<nb::numpy, Shown>(reinterpret_cast<Shown*>(data), sizes.size(), sizes.data(), owner)));
}

// The same over memory that `owner` keeps, read-only.
template <typename Value, typename Shown = Value>
NumpyArray numpy_view(const Value* data, const std::vector<std::int64_t>& shape, nb::handle owner) {
  const std::vector<std::size_t> sizes(shape.begin(), shape.end());
  return nb::borrow<NumpyArray>(nb::cast(
      nb::ndarray<nb::numpy, const Shown>(reinterpret_cast<const Shown*>(data), sizes.size(), sizes.data(), owner)));
}

// A numpy array, or a list of str.
nb::object to_python(ChannelValue channel);
// Names -> values of all channels.
NamedValues to_python(EnvironmentObservation observation);
nb::object to_python(const SqlValue& value);
SqlValue sql_value(nb::handle value);  // of None, int, float, str, bytes, and of numpy's scalars
nb::list rows_of(const Rows& rows);    // tuples

// Throws Error for a value that is of the right type and does not fit: a number too large, a text that is none in
// UTF-8; TypeError for another. `where`: the function and the argument.
[[noreturn]] void refuse_value(nb::handle value, const std::string& where);

template <typename Value>
Value value_of(nb::handle value, const std::string& where) {
  Value result{};
  if (!nb::try_cast(value, result)) refuse_value(value, where);
  return result;
}

// Numbers as they come: a number, lists, tuples, numpy arrays of one axis. `what`: for complaints.
std::vector<double> numbers(nb::handle values, const char* what);

// Calls Python; what it raises becomes an error that any thread may hold: a failure, or where it is no Exception
// (KeyboardInterrupt, SystemExit), an Interruption. `promise`: what Python gives, for complaints.
template <typename Work>
auto ask_python(const char* promise, const Work& work) {
  const Asking asking;
  if (is_ending()) throw Interruption{std::make_exception_ptr(std::runtime_error("the interpreter is ending"))};
  const Acquired gil;
  try {
    return work();
  } catch (nb::python_error& error) {
    if (!error.matches(PyExc_Exception)) throw Interruption{std::current_exception()};
    const std::string text = error.what();
    error.restore();
    PyErr_Clear();
    throw std::runtime_error(text);
  } catch (const std::bad_cast&) {
    throw std::runtime_error(promise);
  }
}

void bind_errors(nb::module_& module);
void bind_environments(nb::module_& module);
void bind_vectors(nb::module_& module);
void bind_catalogue(nb::module_& module);
void bind_sessions(nb::module_& module);

}  // namespace stampede::python
