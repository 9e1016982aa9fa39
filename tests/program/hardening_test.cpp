// How the program and the shared library are linked: what makes a mistake in memory hard to use, from their headers.
#include <elf.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "tests/program/say.h"

namespace stampede::program {
namespace {

// A 64-bit ELF file of this machine.
class Elf {
 public:
  explicit Elf(const std::string& file) : bytes_(file_text(file)) {
    REQUIRE(bytes_.size() > sizeof(Elf64_Ehdr));
    REQUIRE(bytes_.substr(0, SELFMAG) == ELFMAG);
    REQUIRE(bytes_[EI_CLASS] == ELFCLASS64);
    header_ = at<Elf64_Ehdr>(0);
  }
  bool moves() const { return header_.e_type == ET_DYN; }  // it may be loaded anywhere
  bool has(std::uint32_t type) const { return segment(type).p_type == type; }
  // The name is among those that the file gives or takes when it is loaded.
  bool names(const std::string& symbol) const {
    const std::uint64_t address = dynamic(DT_STRTAB);
    for (int i = 0; i < header_.e_phnum; ++i)
      if (const Elf64_Phdr one = nth(i);
          one.p_type == PT_LOAD && address >= one.p_vaddr && address - one.p_vaddr < one.p_filesz) {
        const std::string all = bytes_.substr(one.p_offset + (address - one.p_vaddr), dynamic(DT_STRSZ));
        return all.find('\0' + symbol + '\0') != std::string::npos;
      }
    return false;
  }
  bool runs_stack() const { return !has(PT_GNU_STACK) || (segment(PT_GNU_STACK).p_flags & PF_X) != 0; }
  bool writes_code() const {
    for (int i = 0; i < header_.e_phnum; ++i)
      if (const Elf64_Phdr one = nth(i);
          one.p_type == PT_LOAD && (one.p_flags & PF_W) != 0 && (one.p_flags & PF_X) != 0)
        return true;
    return false;
  }
  std::uint64_t dynamic(std::int64_t tag) const {
    const Elf64_Phdr place = segment(PT_DYNAMIC);
    for (std::uint64_t k = 0; k + sizeof(Elf64_Dyn) <= place.p_filesz; k += sizeof(Elf64_Dyn))
      if (const auto one = at<Elf64_Dyn>(place.p_offset + k); one.d_tag == tag) return one.d_un.d_val;
    return 0;
  }

 private:
  template <typename Part>
  Part at(std::uint64_t place) const {
    Part part;
    REQUIRE(place + sizeof part <= bytes_.size());
    std::memcpy(&part, bytes_.data() + place, sizeof part);
    return part;
  }
  Elf64_Phdr nth(int i) const {
    return at<Elf64_Phdr>(header_.e_phoff + static_cast<std::uint64_t>(i) * header_.e_phentsize);
  }
  Elf64_Phdr segment(std::uint32_t type) const {
    for (int i = 0; i < header_.e_phnum; ++i)
      if (nth(i).p_type == type) return nth(i);
    return {};
  }
  std::string bytes_;
  Elf64_Ehdr header_{};
};

}  // namespace

TEST_CASE(
    "the program and the library are loaded anywhere, bind all at once, and neither stack nor tables can be bent") {
  for (const std::string file : {STAMPEDE_PROGRAM, STAMPEDE_LIBRARY}) {
    INFO(file);
    const Elf elf(file);
    CHECK(elf.moves());
    CHECK(elf.has(PT_GNU_RELRO));
    CHECK(((elf.dynamic(DT_FLAGS) & DF_BIND_NOW) != 0 || (elf.dynamic(DT_FLAGS_1) & DF_1_NOW) != 0));
    CHECK_FALSE(elf.runs_stack());
    CHECK_FALSE(elf.writes_code());
    CHECK(elf.dynamic(DT_TEXTREL) == 0);
    CHECK(elf.names("__stack_chk_fail"));
#ifdef NDEBUG  // builds for debugging go without
    CHECK(elf.names("__snprintf_chk"));
#endif
  }
  CHECK((Elf(STAMPEDE_PROGRAM).dynamic(DT_FLAGS_1) & DF_1_PIE) != 0);
}

}  // namespace stampede::program
