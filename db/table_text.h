// Answers as text: a table for people, CSV (RFC 4180 but for line ends) and JSON for programs.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "db/query.h"

namespace stampede {

enum class TextFormat { table, csv, json };

// Writes rows as they come; a table's widths are those of its first 1,000 rows. Lifetime: `out` outlives it.
class RowWriter : public RowReceiver {
 public:
  virtual void finish() = 0;  // what follows the last row
};
std::unique_ptr<RowWriter> row_writer(TextFormat format, std::ostream& out);

// Numbers right, texts left, real numbers with six digits, NULL as such; a last line says when rows were cut.
std::string to_table(const QueryResult& result);

// Lines end with LF alone, as other tools of the shell want them; a header; texts quoted where they must be. NULL is
// nothing, an empty text is "". Real numbers read back to the last bit. Blobs are hexadecimal.
std::string to_csv(const QueryResult& result);

// A list of objects, one a row, keys in the order of columns. Real numbers read back to the last bit; infinities and
// blobs are texts (`Infinity`, hexadecimal).
std::string to_json(const QueryResult& result);

std::string json_text(std::string_view text);  // quoted and escaped; bytes that are not UTF-8 become U+FFFD

}  // namespace stampede
