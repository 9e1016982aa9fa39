#include "tests/fuzz/catalogue.h"

#include <sqlite3.h>

#include <fstream>
#include <memory>

#include "tests/db/sample_episode.h"

namespace stampede::fuzz {
namespace fs = std::filesystem;
namespace {

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;
using Statement = std::unique_ptr<sqlite3_stmt, Close>;

Statement prepared(const Database& database, const std::string& text) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database.get(), text.c_str(), -1, &statement, nullptr);
  return Statement(statement);
}

struct Cell {
  std::string table, column;
};

struct Sound {
  std::string bytes;  // of the file
  std::vector<Cell> cells;
};

Sound sound_catalogue(const fs::path& file) {
  fs::remove(file);
  EpisodeRecord episode = test::sample_episode("lift", "colour=red", 1);
  episode.images = test::sample_images(episode, {0, 2}, {"rgb", "depth"}, 60);
  Catalogue catalogue = Catalogue::write(file);
  catalogue.add(episode, test::kEngine);
  Sound sound;
  const Rows names = catalogue.query(
      "SELECT m.name AS owner, c.name AS own FROM sqlite_master m, pragma_table_info(m.name) c WHERE m.type = 'table' "
      "AND m.name NOT LIKE 'sqlite%' ORDER BY 1, 2");
  for (std::size_t row = 0; row < names.size(); ++row)
    sound.cells.push_back({names.text(row, "owner"), names.text(row, "own")});
  catalogue.close();
  std::ifstream in(file, std::ios::binary);
  sound.bytes.assign(std::istreambuf_iterator<char>(in), {});
  return sound;
}

// Takes bytes from the front; where there are no more, zeros.
class Front {
 public:
  explicit Front(std::string_view bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  std::string_view text(std::size_t size) {
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <typename Number>
  Number number() {
    Number value{};
    text(sizeof(Number)).copy(reinterpret_cast<char*>(&value), sizeof(Number));
    return value;
  }

 private:
  std::string_view rest_;
};

void change_cell(const Database& database, const Cell& cell, Front& front) {
  const std::string one = " LIMIT 1 OFFSET " + std::to_string(front.number<std::uint8_t>() % 16);
  const int what = front.number<std::uint8_t>() % 6;
  const std::string text = what == 0 ? "DELETE FROM \"" + cell.table + "\"" + one
                                     : "UPDATE \"" + cell.table + "\" SET \"" + cell.column + "\" = ?1" + one;
  const Statement statement = prepared(database, text);
  std::string_view bytes;
  switch (what) {
    case 1:
      sqlite3_bind_int64(statement.get(), 1, front.number<std::int8_t>());
      break;
    case 2:
      sqlite3_bind_int64(statement.get(), 1, front.number<std::int64_t>());
      break;
    case 3:
      sqlite3_bind_double(statement.get(), 1, front.number<double>());
      break;
    case 4:
      bytes = front.text(front.number<std::uint8_t>());
      sqlite3_bind_text(statement.get(), 1, bytes.data(), static_cast<int>(bytes.size()), SQLITE_STATIC);
      break;
    default:  // NULL
      break;
  }
  sqlite3_step(statement.get());  // what the table itself refuses stays as it was
}

}  // namespace

void write_altered_catalogue(const fs::path& file, std::string_view changes) {
  static const Sound sound = sound_catalogue(file);
  std::string bytes = sound.bytes;
  Front front(changes);
  const bool of_the_file = front.number<std::uint8_t>() % 8 == 7;
  while (of_the_file && !front.empty()) {
    const std::size_t at = front.number<std::uint32_t>() % bytes.size();
    const std::string_view other = front.text(front.number<std::uint8_t>() % 16 + 1U);
    bytes.replace(at, std::min(other.size(), bytes.size() - at), other.substr(0, bytes.size() - at));
  }
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  if (of_the_file) return;
  sqlite3* opened = nullptr;
  sqlite3_open(file.c_str(), &opened);
  const Database database(opened);
  sqlite3_exec(opened,
               "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA ignore_check_constraints = ON; BEGIN",
               nullptr, nullptr, nullptr);
  while (!front.empty()) change_cell(database, sound.cells[front.number<std::uint16_t>() % sound.cells.size()], front);
  sqlite3_exec(opened, "COMMIT", nullptr, nullptr, nullptr);
}

}  // namespace stampede::fuzz
