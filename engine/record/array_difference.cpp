#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <type_traits>

#include "engine/record/arrays.h"

namespace stampede {
namespace {

template <typename Value>
bool same(Value a, Value b) {
  if constexpr (std::is_floating_point_v<Value>)
    if (std::isnan(a) && std::isnan(b)) return true;  // known to neither
  return a == b;
}

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
template <typename Whole>
std::string shown(Whole value) {
  return std::to_string(value);
}

std::string shape_text(const ArrayColumn& column) {
  std::string text;
  for (const std::int64_t extent : column.shape) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return std::string(column.type()) + " " + text;
}

// Values of a row, and which of them is wrong: `joint_positions (panda.joint3)`.
struct Difference {
  std::size_t row = 0;
  std::string text;
};

std::optional<Difference> difference_in(const ArrayColumn& stored, const ArrayColumn& now) {
  return std::visit(
      [&](const auto& values) -> std::optional<Difference> {
        const auto& others = std::get<std::decay_t<decltype(values)>>(now.data);
        const std::size_t rows =
            now.shape.empty() ? 1 : static_cast<std::size_t>(std::max<std::int64_t>(1, now.shape[0]));
        const std::size_t width = std::max<std::size_t>(1, values.size() / rows);
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (same(values[i], others[i])) continue;
          const std::size_t place = i % width;
          const std::string which = place < now.labels.size() ? now.labels[place] : std::to_string(place);
          return Difference{i / width, now.name + (width > 1 ? " (" + which + ")" : "") + ": stored " +
                                           shown(values[i]) + ", now " + shown(others[i])};
        }
        return std::nullopt;
      },
      stored.data);
}

}  // namespace

std::string first_difference(const EpisodeArrays& stored, const EpisodeArrays& now) {
  std::optional<Difference> first;
  for (const ArrayColumn& column : now.columns) {
    const ArrayColumn* other = stored.find(column.name);
    if (other == nullptr) return column.name + " is not stored";
    if (other->shape != column.shape || other->data.index() != column.data.index())
      return column.name + ": stored " + shape_text(*other) + ", now " + shape_text(column);
    const std::optional<Difference> found = difference_in(*other, column);
    if (!found) continue;
    if (column.rate_hz != now.frame_hz) {  // rows that are no frames: told when frames agree
      if (!first) return "sample " + std::to_string(found->row) + ", " + found->text;
    } else if (!first || found->row < first->row) {
      first = found;
    }
  }
  return first ? "frame " + std::to_string(first->row) + ", " + first->text : std::string();
}

}  // namespace stampede
