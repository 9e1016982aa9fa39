#include "db/functions.h"

#include <regex.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace stampede::sql {
namespace {

// All values of an aggregate, in the order in which they came: a window lets go of its first one.
struct Values {
  std::vector<double> all;
  std::size_t gone = 0;
  std::optional<double> share;  // of percentile

  std::vector<double> left() const { return {all.begin() + static_cast<std::ptrdiff_t>(gone), all.end()}; }
};

// In SQLite's own memory is a pointer alone: it is zeroed there and freed without a destructor.
Values** slot(sqlite3_context* context, bool make) {
  auto** place = static_cast<Values**>(sqlite3_aggregate_context(context, make ? sizeof(Values*) : 0));
  if (place && make && !*place) *place = new (std::nothrow) Values;
  return place;
}

void complain(sqlite3_context* context, const std::string& what) {
  sqlite3_result_error(context, what.c_str(), static_cast<int>(what.size()));
}

void add(sqlite3_context* context, int count, sqlite3_value** arguments) {
  const std::string name = static_cast<const char*>(sqlite3_user_data(context));
  const int type = sqlite3_value_type(arguments[0]);
  Values** place = slot(context, true);
  if (!place || !*place) return sqlite3_result_error_nomem(context);
  if (count == 2) {
    const int kind = sqlite3_value_type(arguments[1]);
    const double share = sqlite3_value_double(arguments[1]) / 100;
    if ((kind != SQLITE_INTEGER && kind != SQLITE_FLOAT) || !(share >= 0 && share <= 1))
      return complain(context, name + "(x, p): p is a number from 0 to 100");
    if ((*place)->share.value_or(share) != share) return complain(context, name + "(x, p): p is the same for all rows");
    (*place)->share = share;
  }
  if (type == SQLITE_NULL) return;
  if (type != SQLITE_INTEGER && type != SQLITE_FLOAT) return complain(context, name + "() takes numbers");
  try {
    (*place)->all.push_back(sqlite3_value_double(arguments[0]));
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  }
}

void remove_first(sqlite3_context* context, int, sqlite3_value** arguments) {
  Values** place = slot(context, false);
  if (place && *place && sqlite3_value_type(arguments[0]) != SQLITE_NULL) ++(*place)->gone;
}

using Answer = std::optional<double> (*)(std::vector<double>, double share);

// Linear between the two values nearest to it.
std::optional<double> at_share(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[static_cast<std::size_t>(below)], part = place - static_cast<double>(below);
  if (part == 0) return low;
  return low + part * (*std::min_element(values.begin() + below + 1, values.end()) - low);
}

std::optional<double> deviation(const std::vector<double>& values, std::size_t lost) {
  if (values.size() <= lost) return std::nullopt;
  double mean = 0, sum = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - lost));
}

void tell(sqlite3_context* context, const Values* values, Answer answer) {
  std::optional<double> value;
  try {
    if (values) value = answer(values->left(), values->share.value_or(0.5));
  } catch (const std::bad_alloc&) {
    return sqlite3_result_error_nomem(context);
  }
  if (value)
    sqlite3_result_double(context, *value);
  else
    sqlite3_result_null(context);
}

template <Answer answer>
void value_now(sqlite3_context* context) {
  Values** place = slot(context, false);
  tell(context, place ? *place : nullptr, answer);
}

template <Answer answer>
void value_at_end(sqlite3_context* context) {
  Values** place = slot(context, false);
  const std::unique_ptr<Values> values(place ? *place : nullptr);
  if (place) *place = nullptr;
  tell(context, values.get(), answer);
}

std::optional<double> of_sample(std::vector<double> values, double) { return deviation(values, 1); }
std::optional<double> of_all(std::vector<double> values, double) { return deviation(values, 0); }

struct Pattern {
  ~Pattern() {
    if (made) regfree(&expression);
  }
  regex_t expression{};
  bool made = false;
};

void forget_pattern(void* pattern) { delete static_cast<Pattern*>(pattern); }

// Made once for all rows where the pattern is the same in each.
const Pattern* pattern_of(sqlite3_context* context, sqlite3_value* text) {
  if (const void* kept = sqlite3_get_auxdata(context, 0)) return static_cast<const Pattern*>(kept);
  auto pattern = std::make_unique<Pattern>();
  const char* source = reinterpret_cast<const char*>(sqlite3_value_text(text));
  const int code = regcomp(&pattern->expression, source ? source : "", REG_EXTENDED | REG_NOSUB);
  pattern->made = code == 0;
  if (code != 0) {
    std::string why(200, '\0');
    why.resize(regerror(code, &pattern->expression, why.data(), why.size()) - 1);
    complain(context, "regexp: " + std::string(source ? source : "") + ": " + why);
    return nullptr;
  }
  sqlite3_set_auxdata(context, 0, pattern.release(), forget_pattern);
  const auto* kept = static_cast<const Pattern*>(sqlite3_get_auxdata(context, 0));
  if (!kept) sqlite3_result_error_nomem(context);
  return kept;
}

void regexp(sqlite3_context* context, int, sqlite3_value** arguments) {
  for (const int i : {0, 1})
    if (sqlite3_value_type(arguments[i]) == SQLITE_NULL) return sqlite3_result_null(context);
  const Pattern* pattern = pattern_of(context, arguments[0]);
  if (!pattern) return;
  const char* text = reinterpret_cast<const char*>(sqlite3_value_text(arguments[1]));
  sqlite3_result_int(context, text && regexec(&pattern->expression, text, 0, nullptr, 0) == 0);
}

std::optional<Origin> origin(sqlite3_context* context, sqlite3_value* episode) {
  if (sqlite3_value_type(episode) != SQLITE_INTEGER) return std::nullopt;
  return (*static_cast<const OriginOf*>(sqlite3_user_data(context)))(sqlite3_value_int64(episode));
}

void file_of(sqlite3_context* context, int, sqlite3_value** arguments) {
  if (const auto found = origin(context, arguments[0]))
    sqlite3_result_text64(context, found->file.data(), found->file.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
}

void number_in_file(sqlite3_context* context, int, sqlite3_value** arguments) {
  if (const auto found = origin(context, arguments[0])) sqlite3_result_int64(context, found->episode);
}

void forget_origins(void* origin_of) { delete static_cast<OriginOf*>(origin_of); }

constexpr int kPure = SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_DIRECTONLY;

template <Answer answer>
void add_aggregate(sqlite3* handle, const char* name, int arguments) {
  sqlite3_create_window_function(handle, name, arguments, kPure, const_cast<char*>(name), add, value_at_end<answer>,
                                 value_now<answer>, remove_first, nullptr);
}

}  // namespace

void add_functions(sqlite3* handle) {
  add_aggregate<at_share>(handle, "median", 1);
  add_aggregate<at_share>(handle, "percentile", 2);
  add_aggregate<of_sample>(handle, "stddev", 1);
  add_aggregate<of_all>(handle, "stddev_pop", 1);
  sqlite3_create_function_v2(handle, "regexp", 2, kPure, nullptr, regexp, nullptr, nullptr, nullptr);
}

void add_origins(sqlite3* handle, OriginOf origin_of) {
  for (const auto& [name, function] : {std::pair{"file_of", &file_of}, std::pair{"number_in_file", &number_in_file}})
    sqlite3_create_function_v2(handle, name, 1, kPure, new OriginOf(origin_of), function, nullptr, nullptr,
                               forget_origins);
}

}  // namespace stampede::sql
