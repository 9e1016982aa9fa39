// The one way in which JSON comes in, whoever wrote it: a file, a policy, a server, a column of a catalogue.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// What is beyond is refused before it costs memory or, where values lie in values, the stack: copying, writing and
// deleting a value take a stack frame for each that it lies in.
struct JsonLimits {
  std::size_t bytes = std::size_t{256} << 20;
  std::size_t values = 10'000'000;
  int depth = 64;
};

// Throws Error, `where:LINE` and with this cure: what is no JSON (RFC 8259, in UTF-8, perhaps after a byte order mark),
// is cut, or is beyond the limits; numbers that are not finite and whole ones beyond 64 bits; a key that an object has
// twice; texts that hold the character 0. With no `where`, of the line too nothing is said.
nlohmann::json json_from_text(std::string_view text, const std::string& where, const std::string& cure,
                              const JsonLimits& limits = {});
nlohmann::json json_from_file(const std::filesystem::path& file, const std::string& cure,
                              const JsonLimits& limits = {});

// Nothing where the above would throw.
std::optional<nlohmann::json> json_if_any(std::string_view text, const JsonLimits& limits = {});

// A list of texts, as a column of a file of ours holds them. Throws Error.
std::vector<std::string> texts_from_json(std::string_view text, const std::string& where);

// Throws Error for a field that is not known, with the nearest name.
void require_known_fields(const nlohmann::json& object, const std::vector<std::string>& known,
                          const std::string& where);

}  // namespace stampede
