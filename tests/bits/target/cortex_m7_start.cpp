// Reset of the Cortex-M7: FPU on, data in place, then main.
#include <cstdint>
#include <cstring>

extern "C" {
extern char data_begin, data_end, data_in_flash, bss_begin, bss_end, stack_top;
void __libc_init_array();
int main();
void* __dso_handle = nullptr;  // nothing is ever unloaded
void _init() {}
void _fini() {}

void start_up();
void stop_at_fault();

extern const std::uintptr_t vectors[];
__attribute__((section(".vectors"), used)) const std::uintptr_t vectors[] = {
    reinterpret_cast<std::uintptr_t>(&stack_top), reinterpret_cast<std::uintptr_t>(start_up),
    reinterpret_cast<std::uintptr_t>(stop_at_fault),  // NMI
    reinterpret_cast<std::uintptr_t>(stop_at_fault),  // HardFault
};

void start_up() {
  auto* const coprocessor_access = reinterpret_cast<volatile std::uint32_t*>(0xE000ED88);  // CPACR
  *coprocessor_access = *coprocessor_access | 0x00F00000u;                                 // full access to the FPU
  asm volatile("dsb\nisb" ::: "memory");
  std::memcpy(&data_begin, &data_in_flash, static_cast<std::size_t>(&data_end - &data_begin));
  std::memset(&bss_begin, 0, static_cast<std::size_t>(&bss_end - &bss_begin));
  __libc_init_array();
  main();
  stop_at_fault();  // main never returns
}

void stop_at_fault() {
  for (;;) asm volatile("bkpt 0");  // QEMU ends here with an error
}
}
