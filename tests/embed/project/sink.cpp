// Episodes without any catalogue: each goes to a function of the program's, which writes NumPy files.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stampede/session.h>

namespace {

// One column as NumPy reads it: `numpy.load("0_joint_positions.npy")`.
void write_npy(const std::filesystem::path& path, const stampede::ArrayColumn& column) {
  std::string shape;
  for (const std::int64_t extent : column.shape) shape += std::to_string(extent) + ",";
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + ")}";
  header.resize((header.size() + 11 + 63) / 64 * 64 - 11, ' ');  // so that the numbers begin at a multiple of 64 bytes
  header += '\n';
  const auto size = static_cast<std::uint16_t>(header.size());
  const char start[] = {'\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, static_cast<char>(size & 255),
                        static_cast<char>(size >> 8)};
  std::ofstream file(path, std::ios::binary);
  file.exceptions(std::ios::failbit | std::ios::badbit);  // a full disk ends the run
  file.write(start, sizeof start) << header;
  const std::span<const double> numbers = column.reals();
  file.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(numbers.size_bytes()));
}

}  // namespace

int main() {
  std::filesystem::remove_all("sink");
  std::filesystem::create_directory("sink");
  stampede::Session session({});
  std::ofstream list("sink/episodes.csv");
  list << "number,task,variation,seed,outcome,reason,seconds\n";
  std::uintmax_t bytes = 0;
  int number = 0;
  std::weak_ptr<const stampede::EpisodeRecord> last;
  bool freed = true;
  const auto sink = [&](const stampede::Episode& e) {
    freed = freed && last.expired();  // the one before is gone from memory
    last = e.record;
    const stampede::EpisodeArrays arrays = session.arrays(e, {{"joint_positions", "gripper_pose", "action"}});
    for (const char* name : {"joint_positions", "gripper_pose", "action/joint_position"}) {
      std::string file = std::to_string(number) + "_" + name + ".npy";
      std::replace(file.begin(), file.end(), '/', '_');
      write_npy("sink/" + file, arrays.column(name));
      bytes += std::filesystem::file_size("sink/" + file);
    }
    list << number++ << ',' << e.task << ",\"" << e.variation << "\"," << e.seed << ','
         << (e.outcome == stampede::Outcome::success ? "success," : "failure,") << e.reason << ',' << e.duration_s
         << '\n';
  };
  const stampede::RunTally tally = session.run_all(
      {.tasks = {"reach_target", "close_drawer"}, .episodes = 4, .workers = 2, .sink = sink});
  std::printf("%d episodes, %d succeeded, %d kB\n", number, static_cast<int>(tally.succeeded),
              static_cast<int>(bytes / 1000));
  const bool first = std::filesystem::file_size("sink/0_gripper_pose.npy") % 8 == 0;
  return number == 8 && tally.finished == 8 && freed && first ? 0 : 1;
}
