// Traps of floating point in the tests (builds with PSSMLT_TRAPS): enabled for every test on its
// own thread, on top of those of rendering threads. A trap does not end the test: its place is
// written, once, to $PSSMLT_TRAP_LOG (else to standard error), and the thread goes on without traps
// until the next test or unit, so that one run finds all places.
#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "core/base/float_traps.h"

namespace pssmlt {
namespace {

constexpr int most_places = 1024, frames = 12;
std::atomic<void*> places[most_places];

// True the first time that this instruction traps.
bool is_new(void* place) {
  for (std::atomic<void*>& p : places) {
    void* empty = nullptr;
    if (p.compare_exchange_strong(empty, place)) return true;
    if (empty == place) return false;
  }
  return false;
}

const char* kind_of(int code) {
  return code == FPE_FLTDIV ? "divide" : code == FPE_FLTOVF ? "overflow" : "invalid";
}

// Not safe in a signal handler in general; here the signal is synchronous, in arithmetic.
void report(const siginfo_t& info) {
  const char* const path = std::getenv("PSSMLT_TRAP_LOG");
  const int file = path ? open(path, O_WRONLY | O_CREAT | O_APPEND, 0644) : STDERR_FILENO;
  void* stack[frames];
  const int depth = backtrace(stack, frames);
  const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
  char line[4096];
  int end = std::snprintf(line, sizeof line, "trap %s in %s.%s:", kind_of(info.si_code),
                          test ? test->test_suite_name() : "-", test ? test->name() : "-");
  // Frame 0 is this function, 1 the handler, 2 the kernel's.
  for (int i = 3; i < depth && end < int{sizeof line} - 300; ++i) {
    Dl_info symbol{};
    if (dladdr(stack[i], &symbol) == 0) continue;
    int failed = 0;
    char* const name = symbol.dli_sname
                           ? abi::__cxa_demangle(symbol.dli_sname, nullptr, nullptr, &failed)
                           : nullptr;
    const char* object = symbol.dli_fname ? symbol.dli_fname : "?";
    for (const char* c = object; *c != 0; ++c) {
      if (*c == '/') object = c + 1;
    }
    end += std::snprintf(line + end, sizeof line - static_cast<size_t>(end), " %s(%.150s)+%#lx",
                         object,
                         name               ? name
                         : symbol.dli_sname ? symbol.dli_sname
                                            : "?",
                         static_cast<unsigned long>(static_cast<char*>(stack[i]) -
                                                    static_cast<char*>(symbol.dli_fbase)));
    std::free(name);
  }
  line[end++] = '\n';
  const ssize_t written = write(file, line, static_cast<size_t>(end));
  (void)written;
  if (path) close(file);
}

void handle(int, siginfo_t* info, void* context) {
  if (is_new(info->si_addr)) report(*info);
  // The instruction runs again, without traps.
  auto* const machine = static_cast<ucontext_t*>(context);
  machine->uc_mcontext.fpregs->mxcsr |= 0x1F80u;
  machine->uc_mcontext.fpregs->mxcsr &= ~0x3Fu;
  machine->uc_mcontext.fpregs->cwd |= 0x3Fu;
  machine->uc_mcontext.fpregs->swd &= static_cast<unsigned short>(~0x80FFu);
}

class TrapListener final : public testing::EmptyTestEventListener {
 public:
  void OnTestStart(const testing::TestInfo&) override { traps_.emplace(); }
  void OnTestEnd(const testing::TestInfo&) override { traps_.reset(); }

 private:
  std::optional<FloatTraps> traps_;
};

// Before main: gtest's own main needs no word of this.
const bool installed = [] {
  void* first = nullptr;
  backtrace(&first, 1);  // loads what it needs now
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGFPE, &action, nullptr);
  testing::UnitTest::GetInstance()->listeners().Append(new TrapListener);
  return true;
}();

}  // namespace
}  // namespace pssmlt
