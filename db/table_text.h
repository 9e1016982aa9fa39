// Answers as text: a table for people, CSV (RFC 4180) and JSON for programs.
#pragma once

#include <string>

#include "db/query.h"

namespace stampede {

// Numbers right, texts left, real numbers with six digits, NULL as nothing; a last line says when rows were cut.
std::string to_table(const QueryResult& result);

// CRLF lines, a header; texts quoted where they must be. NULL is nothing, an empty text is "". Real numbers read back
// to the last bit. Blobs are hexadecimal.
std::string to_csv(const QueryResult& result);

// A list of objects, one a row, keys in the order of columns. Real numbers read back to the last bit; infinities and
// blobs are texts (`Infinity`, hexadecimal).
std::string to_json(const QueryResult& result);

std::string json_text(std::string_view text);  // quoted and escaped; bytes that are not UTF-8 become U+FFFD

}  // namespace stampede
