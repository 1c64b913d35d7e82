// The part of libgomp that stillhook uses, on std::thread: for ThreadSanitizer, which does not see how libgomp, that is
// not built with it, starts its threads, waits for them and shares out a loop, and reports races that are none. Linked
// in libgomp's place (tests/rotation/relink.py).
//
// A region orders threads where OpenMP promises it, at its begin and its end, and nowhere else: iterations are shared
// out by a counter of relaxed order, or the sanitizer would take two iterations for ordered that are not.
#include <array>
#include <atomic>
#include <cstdlib>
#include <thread>
#include <vector>

namespace {

constexpr unsigned kLoops = 64;  // loops of one region that threads may be in at the same time

struct Team {
  bool active = false;                                     // more than one thread, here or further out
  std::array<std::atomic<unsigned long>, kLoops> taken{};  // chunks of each loop of the region
};

struct Loop {
  unsigned long first = 0, count = 0, chunk = 1, stride = 1;  // count: iterations
};

int threads_asked = 0;
thread_local Team* team = nullptr;
thread_local unsigned loop_number = 0;
thread_local Loop loop;

int most_threads() {
  if (threads_asked > 0) return threads_asked;
  const char* asked = std::getenv("OMP_NUM_THREADS");
  const int n = asked ? std::atoi(asked) : static_cast<int>(std::thread::hardware_concurrency());
  return n > 0 ? n : 1;
}

/// First iteration of the next chunk and how many it has; false when the loop has no more.
bool next_chunk(unsigned long& first, unsigned long& count) {
  const unsigned long k = team->taken[loop_number % kLoops].fetch_add(1, std::memory_order_relaxed);
  if (k >= (loop.count + loop.chunk - 1) / loop.chunk) return false;
  first = k * loop.chunk;
  count = first + loop.chunk < loop.count ? loop.chunk : loop.count - first;
  return true;
}

template <typename Number>
bool hand_out(Number* begin, Number* end) {
  unsigned long first = 0, count = 0;
  if (!next_chunk(first, count)) return false;
  *begin = static_cast<Number>(loop.first + first * loop.stride);
  *end = static_cast<Number>(loop.first + (first + count) * loop.stride);
  return true;
}

/// Unsigned arithmetic wraps: the same for loops of signed numbers and for loops that count down.
void begin_loop(unsigned long start, unsigned long end, unsigned long stride, unsigned long chunk, bool up) {
  const unsigned long span = up ? end - start : start - end, step = up ? stride : 0 - stride;
  loop = {start, (span + step - 1) / step, chunk > 0 ? chunk : 1, stride};
}

void work(Team* mine, void (*region)(void*), void* data) {
  Team* const outer = team;
  const unsigned outer_number = loop_number;
  const Loop outer_loop = loop;
  team = mine;
  loop_number = 0;
  region(data);
  team = outer;
  loop_number = outer_number;
  loop = outer_loop;
}

void run_region(void (*region)(void*), void* data, unsigned asked) {
  const unsigned threads = team ? 1 : asked > 0 ? asked : static_cast<unsigned>(most_threads());
  Team mine;
  mine.active = threads > 1 || (team && team->active);
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work, &mine, region, data);
  work(&mine, region, data);
  for (std::thread& other : others) other.join();
}

}  // namespace

extern "C" {

void GOMP_parallel(void (*region)(void*), void* data, unsigned threads, unsigned) { run_region(region, data, threads); }

bool GOMP_loop_nonmonotonic_dynamic_next(long* begin, long* end) { return hand_out(begin, end); }

bool GOMP_loop_nonmonotonic_dynamic_start(long start, long end, long step, long chunk, long* first, long* last) {
  const bool up = step > 0, none = up ? end <= start : end >= start;
  begin_loop(static_cast<unsigned long>(start), static_cast<unsigned long>(none ? start : end),
             static_cast<unsigned long>(step), static_cast<unsigned long>(chunk), up);
  return hand_out(first, last);
}

bool GOMP_loop_ull_nonmonotonic_dynamic_next(unsigned long long* begin, unsigned long long* end) {
  return hand_out(begin, end);
}

bool GOMP_loop_ull_nonmonotonic_dynamic_start(bool up, unsigned long long start, unsigned long long end,
                                              unsigned long long step, unsigned long long chunk,
                                              unsigned long long* first, unsigned long long* last) {
  const bool none = up ? end <= start : end >= start;
  begin_loop(start, none ? start : end, step, chunk, up);
  return hand_out(first, last);
}

void GOMP_loop_end_nowait() { ++loop_number; }

// A region that is one loop, whose bounds come with the call: each thread begins the loop itself.
void GOMP_parallel_loop_nonmonotonic_dynamic(void (*region)(void*), void* data, unsigned threads, long start, long end,
                                             long step, long chunk, unsigned) {
  struct Bound {
    void (*region)(void*);
    void* data;
    long start, end, step, chunk;
  } bound{region, data, start, end, step, chunk};
  run_region(
      [](void* given) {
        const Bound& b = *static_cast<Bound*>(given);
        const bool up = b.step > 0, none = up ? b.end <= b.start : b.end >= b.start;
        begin_loop(static_cast<unsigned long>(b.start), static_cast<unsigned long>(none ? b.start : b.end),
                   static_cast<unsigned long>(b.step), static_cast<unsigned long>(b.chunk), up);
        b.region(b.data);
      },
      &bound, threads);
}

int omp_get_max_threads() { return most_threads(); }
int omp_get_num_procs() { return static_cast<int>(std::thread::hardware_concurrency()); }
void omp_set_num_threads(int threads) { threads_asked = threads; }
int omp_in_parallel() { return team && team->active; }

}  // extern "C"
