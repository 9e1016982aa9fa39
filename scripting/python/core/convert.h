// Between what C++ and what Python users see: arrays, actions, answers.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <stampede/environment.h>
#include <stampede/rows.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stampede::python {

namespace nb = nanobind;

// A numpy array that owns the values, without a copy. Bytes that are truth values become numpy's bool.
template <typename Value, typename Shown = Value>
nb::object numpy_array(std::vector<Value> values, const std::vector<std::int64_t>& shape) {
  auto owned = std::make_unique<std::vector<Value>>(std::move(values));
  Value* data = owned->data();
  nb::capsule owner(owned.release(), [](void* held) noexcept { delete static_cast<std::vector<Value>*>(held); });
  const std::vector<std::size_t> sizes(shape.begin(), shape.end());
  static_assert(sizeof(Shown) == sizeof(Value));
  return nb::cast(nb::ndarray<nb::numpy, Shown>(reinterpret_cast<Shown*>(data), sizes.size(), sizes.data(), owner));
}

// The same over memory that `owner` keeps, read-only.
template <typename Value, typename Shown = Value>
nb::object numpy_view(const Value* data, const std::vector<std::int64_t>& shape, nb::handle owner) {
  const std::vector<std::size_t> sizes(shape.begin(), shape.end());
  return nb::cast(
      nb::ndarray<nb::numpy, const Shown>(reinterpret_cast<const Shown*>(data), sizes.size(), sizes.data(), owner));
}

// A numpy array, or a list of str.
nb::object to_python(ChannelValue channel);
// Names -> values of all channels.
nb::dict to_python(EnvironmentObservation observation);
nb::object to_python(const SqlValue& value);
SqlValue sql_value(nb::handle value);  // of None, int, float, str, bytes, and of numpy's scalars
nb::list rows_of(const Rows& rows);    // tuples

void bind_errors(nb::module_& module);
void bind_environments(nb::module_& module);
void bind_vectors(nb::module_& module);
void bind_catalogue(nb::module_& module);
void bind_sessions(nb::module_& module);

}  // namespace stampede::python
