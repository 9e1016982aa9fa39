#include "convert.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace stampede::python {
namespace {

bool is_truth(const ChannelValue& channel) {
  return std::holds_alternative<std::vector<std::uint8_t>>(channel.data) && !channel.name.ends_with("_rgb");
}

}  // namespace

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
  if (nb::isinstance<nb::str>(value)) return nb::cast<std::string>(value);
  if (nb::isinstance<nb::bytes>(value)) {
    const auto bytes = nb::borrow<nb::bytes>(value);
    return SqlBlob{std::string(bytes.c_str(), bytes.size())};
  }
  if (nb::hasattr(value, "__index__")) return nb::cast<std::int64_t>(value.attr("__index__")());
  if (nb::hasattr(value, "__float__")) return nb::cast<double>(value.attr("__float__")());
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
