#include "engine/base/processor.h"
#include "engine/sim/screen.h"

namespace stampede {
namespace plain_screen {
#include "engine/sim/screen.inl"
}  // namespace plain_screen

std::uint8_t screen_plain(const ScreenTables& tables, ScreenBatch& batch, bool any) {
  return plain_screen::Screening(tables, batch, any).touching();
}

Screen fastest_screen() { return may_use_avx2() && screen_avx2() != nullptr ? screen_avx2() : screen_plain; }

}  // namespace stampede
