// The only translation unit of the WebAssembly module (tools/build_wasm.py): all of core/online,
// and functions that keep the standard library from printing. Without them the module would import
// output functions only to report that memory is exhausted; a trap does the same.
#include <cstdlib>
#include <new>

#include "online/blended_cubature.cpp"
#include "online/blended_stars.cpp"
#include "online/cubature.cpp"
#include "online/element_probe.cpp"
#include "online/local_modes.cpp"
#include "online/probe_entry.cpp"
#include "online/quartic.cpp"
#include "online/snapspace_online.cpp"
#include "online/star_probe.cpp"
#include "online/tet_density.cpp"
#include "online/tet_rows.cpp"

namespace std {
inline namespace __1 {
[[noreturn]] void __libcpp_verbose_abort(const char*, ...) noexcept { __builtin_trap(); }
}  // namespace __1
}  // namespace std

namespace {
void* checked(void* memory) {
  if (!memory) __builtin_trap();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return checked(std::malloc(size ? size : 1)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return checked(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
