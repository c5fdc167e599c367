// Exceptions of C++ on those of WebAssembly. clang compiles throw and catch to the browser's own instructions; what
// they call is the C++ ABI, which Debian's library for wasm32 was built without. This is the part of it that src/io
// needs: exceptions are thrown, caught by type, thrown again. (No exception_ptr, no nested foreign exceptions, one
// thread.)
//
//   throw   __cxa_allocate_exception → constructor → __cxa_throw → the instruction, with the address of Exception
//   catch   the instruction → _Unwind_CallPersonality says which of the clauses at this place takes it, or none
//           → __cxa_begin_catch … __cxa_end_catch
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <typeinfo>

namespace {

/// Destructors return what they are given, in the C++ ABI of WebAssembly.
using Destructor = void* (*)(void*);

/// Before each object that was thrown.
struct alignas(16) Exception {
  const std::type_info* type;
  Destructor destroy;
  void* caught_as;        ///< the object, as the type of the clause that takes it
  Exception* below;       ///< the one whose handler was running when this one was caught
  std::int32_t handlers;  ///< that are running; negative: thrown again by the innermost

  void* object() { return this + 1; }
};

Exception* innermost = nullptr;

constexpr std::uint32_t kCxxTag = 0;  // the tag of C++ exceptions

[[noreturn]] void throw_it(Exception* exception) { __builtin_wasm_throw(kCxxTag, exception); }

/// As libc++abi declares its types: whether a clause of this type takes an object of the other one, and as what.
class CatchableType : public std::type_info {
 public:
  virtual void noop1() const = 0;
  virtual void noop2() const = 0;
  virtual bool can_catch(const CatchableType* thrown, void*& object) const = 0;
};

// --- the tables that the compiler makes of try blocks: an LSDA a function -------------------------------------

class TableReader {
 public:
  explicit TableReader(const std::uint8_t* at) : at_(at) {}
  [[nodiscard]] const std::uint8_t* at() const { return at_; }
  std::uint8_t byte() { return *at_++; }
  std::uintptr_t unsigned_leb() { return static_cast<std::uintptr_t>(leb().value); }
  std::intptr_t signed_leb() {
    const Leb read = leb();
    const bool negative = (read.last & 0x40) != 0 && read.bits < 64;
    return static_cast<std::intptr_t>(negative ? read.value | (~std::uint64_t{0} << read.bits) : read.value);
  }

 private:
  struct Leb {
    std::uint64_t value = 0;
    unsigned bits = 0;
    std::uint8_t last = 0;
  };
  Leb leb() {
    Leb read;
    do {
      read.last = byte();
      read.value |= std::uint64_t{read.last & 0x7fU} << read.bits;
      read.bits += 7;
    } while ((read.last & 0x80) != 0);
    return read;
  }
  const std::uint8_t* at_;
};

constexpr std::uint8_t kOmitted = 0xff;

/// The number of the clause at a place of a function that takes the exception; 0: there is only clean-up to do.
std::uintptr_t clause_for(Exception& exception, const std::uint8_t* table, std::uintptr_t place) {
  TableReader header(table);
  if (header.byte() != kOmitted) header.unsigned_leb();  // where landing pads start: no addresses here
  const std::uint8_t* types = nullptr;
  if (header.byte() != kOmitted) {
    const std::uintptr_t offset = header.unsigned_leb();
    types = header.at() + offset;
  }
  header.byte();  // how places are written: always as LEB128
  const std::uintptr_t length = header.unsigned_leb();
  TableReader places = header;
  const std::uint8_t* const actions = header.at() + length;
  std::uintptr_t action = 0;
  for (std::uintptr_t i = 0; i <= place; ++i) {
    places.unsigned_leb();  // the place itself, which is its number
    action = places.unsigned_leb();
  }
  while (action != 0) {
    TableReader row(actions + action - 1);
    const std::intptr_t type_number = row.signed_leb();
    const std::uint8_t* const next_from = row.at();
    const std::intptr_t next = row.signed_leb();
    if (type_number > 0) {
      const auto* type = reinterpret_cast<const CatchableType* const*>(types)[-type_number];
      void* object = exception.object();
      // Without a type: catch (...).
      if (type == nullptr || type->can_catch(static_cast<const CatchableType*>(exception.type), object)) {
        exception.caught_as = object;
        return static_cast<std::uintptr_t>(type_number);
      }
    }
    if (next == 0) break;
    action = static_cast<std::uintptr_t>(next_from - actions + next + 1);
  }
  return 0;
}

}  // namespace

extern "C" {

/// Where an exception is being looked at: the code around a catch instruction fills the first two, and reads the third.
struct {
  std::uintptr_t place;
  const std::uint8_t* table;
  std::uintptr_t clause;
} __wasm_lpad_context;

int _Unwind_CallPersonality(void* thrown) {
  auto& context = __wasm_lpad_context;
  context.clause = clause_for(*static_cast<Exception*>(thrown), context.table, context.place);
  return 0;
}

/// Each function with clauses names it; what it would do is done above.
int __gxx_wasm_personality_v0() { return 0; }

void* __cxa_allocate_exception(std::size_t size) noexcept {
  void* const memory = std::aligned_alloc(alignof(Exception), (sizeof(Exception) + size + 15) / 16 * 16);
  if (memory == nullptr) std::terminate();
  return new (memory) Exception() + 1;
}

void __cxa_free_exception(void* object) noexcept { std::free(static_cast<Exception*>(object) - 1); }

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, Destructor destroy) {
  Exception* const exception = static_cast<Exception*>(object) - 1;
  exception->type = type;
  exception->destroy = destroy;
  exception->caught_as = object;
  throw_it(exception);
}

void* __cxa_begin_catch(void* thrown) noexcept {
  auto* const exception = static_cast<Exception*>(thrown);
  exception->handlers = (exception->handlers < 0 ? -exception->handlers : exception->handlers) + 1;
  if (exception != innermost) {
    exception->below = innermost;
    innermost = exception;
  }
  return exception->caught_as;
}

void __cxa_end_catch() {
  Exception* const exception = innermost;
  if (exception->handlers < 0) {  // on its way to another handler
    if (++exception->handlers == 0) innermost = exception->below;
    return;
  }
  if (--exception->handlers > 0) return;
  innermost = exception->below;
  if (exception->destroy != nullptr) exception->destroy(exception->object());
  __cxa_free_exception(exception->object());
}

[[noreturn]] void __cxa_rethrow() {
  if (innermost == nullptr) std::terminate();
  innermost->handlers = -innermost->handlers;
  throw_it(innermost);
}

void* __cxa_get_exception_ptr(void* thrown) noexcept { return static_cast<Exception*>(thrown)->caught_as; }

}  // extern "C"

// Memory that is not there is an error to the user, not the end of the program: the library's own operator new was
// built without exceptions, too.
void* operator new(std::size_t size) {
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto to = static_cast<std::size_t>(alignment);
  if (void* const memory = std::aligned_alloc(to, (size + to - 1) / to * to)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size, std::align_val_t alignment) { return operator new(size, alignment); }
