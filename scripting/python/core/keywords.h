// Keyword arguments of Python as fields of what the engine is asked.
#pragma once

#include <nanobind/nanobind.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "convert.h"

namespace stampede::python {

// One keyword that a function knows. `where`: that function, for complaints.
template <typename Request>
struct Keyword {
  const char* name;
  void (*set)(Request& request, nb::handle value, const char* where);
};

// Sets the field to the value as it is.
template <auto Field, typename Request>
void set_field(Request& request, nb::handle value, const char*) {
  request.*Field = nb::cast<std::remove_cvref_t<decltype(request.*Field)>>(value);
}

// Null: none is called so.
template <typename Request, std::size_t Count>
const Keyword<Request>* find_keyword(const Keyword<Request> (&known)[Count], const std::string& name) {
  const auto* found = std::ranges::find(known, name, &Keyword<Request>::name);
  return found == std::end(known) ? nullptr : found;
}

// Raises TypeError for a word that the function does not know.
template <typename Request, std::size_t Count>
Request from_keywords(const Keyword<Request> (&known)[Count], const nb::kwargs& words, const char* where) {
  Request request;
  for (const auto& [key, value] : words) {
    const auto name = value_of<std::string>(key, where);
    const Keyword<Request>* keyword = find_keyword(known, name);
    if (keyword == nullptr) throw nb::type_error((std::string(where) + "() has no argument '" + name + "'").c_str());
    try {
      keyword->set(request, value, where);
    } catch (const std::bad_cast&) {
      refuse_value(value, std::string(where) + "(" + name + "=)");
    }
  }
  return request;
}

// What goes by that name among these.
template <typename Value>
std::optional<Value> value_named(const std::string& name, const std::vector<std::pair<const char*, Value>>& known) {
  for (const auto& [one, value] : known)
    if (name == one) return value;
  return std::nullopt;
}

}  // namespace stampede::python
