#include "convert.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <stampede/error.h>

#include <limits>

namespace stampede::python {
namespace {

constexpr const char* kParameter = "a parameter of a question";
constexpr long long kSmall = std::numeric_limits<std::int32_t>::max();  // whole numbers up to it fit everywhere

bool is_truth(const ChannelValue& channel) {
  return std::holds_alternative<std::vector<std::uint8_t>>(channel.data) && !channel.name.ends_with("_rgb");
}

bool is_large(nb::handle value) {
  if (!PyLong_Check(value.ptr())) return false;
  int beyond = 0;
  const long long number = PyLong_AsLongLongAndOverflow(value.ptr(), &beyond);
  return beyond != 0 || number > kSmall || number < -kSmall;
}

bool is_broken_text(nb::handle value) {
  if (!PyUnicode_Check(value.ptr())) return false;
  const bool broken = PyUnicode_AsUTF8(value.ptr()) == nullptr;
  PyErr_Clear();
  return broken;
}

// Of a number with thousands of digits Python makes no text.
std::string short_text(nb::handle value) {
  constexpr std::size_t kMost = 60;
  const nb::object text = nb::steal(PyObject_ASCII(value.ptr()));
  if (!text.is_valid()) {
    PyErr_Clear();
    return std::string("a value of type ") + nb::type_name(value.type()).c_str();
  }
  const auto words = nb::cast<std::string>(text);
  return words.size() <= kMost ? words : words.substr(0, kMost) + "...";
}

}  // namespace

void refuse_value(nb::handle value, const std::string& where) {
  const std::string text = short_text(value);
  if (is_large(value)) throw Error(where, text + " is too large", "64 bits at most, 32 for sizes, rates and counts");
  if (is_broken_text(value))
    throw Error(where, text + " is no text that UTF-8 has", "take out halves of characters (lone surrogates)");
  const std::string type = nb::type_name(value.type()).c_str();
  throw nb::type_error((where + " cannot be " + text + ", of type " + type).c_str());
}

nb::object to_python(ChannelValue channel) {
  const bool truth = is_truth(channel);
  return std::visit(
      [&](auto&& values) -> nb::object {
        using Values = std::remove_cvref_t<decltype(values)>;
        if constexpr (std::is_same_v<Values, std::vector<std::string>>) {
          return nb::cast(values);
        } else if constexpr (std::is_same_v<Values, std::vector<std::uint8_t>>) {
          if (truth) return numpy_array<std::uint8_t, bool>(std::move(values), channel.shape);
          return numpy_array(std::move(values), channel.shape);
        } else {
          return numpy_array(std::move(values), channel.shape);
        }
      },
      std::move(channel.data));
}

NamedValues to_python(EnvironmentObservation observation) {
  NamedValues result;
  for (ChannelValue& channel : observation.channels) {
    const nb::str name(channel.name.c_str(), channel.name.size());
    result[name] = to_python(std::move(channel));
  }
  return result;
}

nb::object to_python(const SqlValue& value) {
  return std::visit(
      [](const auto& one) -> nb::object {
        using Value = std::remove_cvref_t<decltype(one)>;
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return nb::none();
        } else if constexpr (std::is_same_v<Value, SqlBlob>) {
          return nb::bytes(one.bytes.data(), one.bytes.size());
        } else {
          return nb::cast(one);
        }
      },
      value);
}

SqlValue sql_value(nb::handle value) {
  if (value.is_none()) return std::monostate{};
  if (nb::isinstance<nb::bool_>(value)) return static_cast<std::int64_t>(nb::cast<bool>(value));
  if (nb::isinstance<nb::str>(value)) return value_of<std::string>(value, kParameter);
  if (nb::isinstance<nb::bytes>(value)) {
    const auto bytes = nb::borrow<nb::bytes>(value);
    return SqlBlob{std::string(bytes.c_str(), bytes.size())};
  }
  if (nb::hasattr(value, "__index__")) return value_of<std::int64_t>(value.attr("__index__")(), kParameter);
  if (nb::hasattr(value, "__float__")) return value_of<double>(value.attr("__float__")(), kParameter);
  throw nb::type_error("a parameter of a question is None, a number, str or bytes");
}

nb::list rows_of(const Rows& rows) {
  nb::list result;
  for (const std::vector<SqlValue>& row : rows.rows) {
    nb::list cells;
    for (const SqlValue& value : row) cells.append(to_python(value));
    result.append(nb::tuple(cells));
  }
  return result;
}

std::vector<double> numbers(nb::handle values, const char* what) {
  if (values.is_none()) return {};
  nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu> array;
  if (nb::try_cast(values, array)) return {array.data(), array.data() + array.size()};
  std::vector<double> list;
  if (nb::try_cast(values, list)) return list;
  double one = 0;
  if (nb::try_cast(values, one)) return {one};
  throw nb::type_error((std::string(what) + " is a list of numbers, or an array of one axis").c_str());
}

}  // namespace stampede::python
