#ifndef debond_support_saved_state_h
#define debond_support_saved_state_h

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

namespace Debond
{
  /** What archives in memory are derived from, those of SavedState. */
  class ArchiveInMemory
  {};

  /** For a serialize() that puts more or less into memory than into a
   *  checkpoint. */
  template <class Archive>
  constexpr bool is_in_memory = std::is_base_of_v<ArchiveInMemory, Archive>;



  /**
   * The state of an object, to go back to. It is what the object's serialize()
   * puts into a checkpoint (serialization.h), but stays in memory and costs
   * little more than a copy of the numbers. What is shared is not copied.
   */
  class SavedState
  {
  public:
    /** Takes the place of what was saved before, whose memory it uses. */
    template <class Object>
    void
    save(Object &object)
    {
      shared.clear();
      Writer  writer(*this);
      writer &object;
    }

    /** Brings back the same object. */
    template <class Object>
    void
    restore(Object &object) const
    {
      Reader  reader(*this);
      reader &object;
    }

  private:
    template <class Derived, bool loads>
    class Archive : public ArchiveInMemory
    {
    public:
      using is_loading = std::bool_constant<loads>;
      using is_saving  = std::bool_constant<!loads>;

      template <typename T>
      Derived &
      operator&(T &value)
      {
        if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
          derived().move(&value, sizeof(T));
        else
          take(value);
        return derived();
      }

    private:
      Derived &
      derived()
      {
        return static_cast<Derived &>(*this);
      }

      template <class T>
      void
      take(T &object)
      {
        object.serialize(derived(), 0);
      }

      template <int R, int C, int O, int MR, int MC>
      void
      take(Eigen::Matrix<double, R, C, O, MR, MC> &matrix)
      {
        if constexpr (R == Eigen::Dynamic || C == Eigen::Dynamic)
          {
            Eigen::Index rows = matrix.rows(), columns = matrix.cols();
            *this &rows &columns;
            matrix.resize(rows, columns);
          }
        derived().move(matrix.data(), matrix.size() * sizeof(double));
      }

      template <typename T, std::size_t n>
      void
      take(std::array<T, n> &values)
      {
        for (T &value : values)
          *this &value;
      }

      template <typename T>
      void
      take(std::vector<T> &values)
      {
        std::size_t size = values.size();
        *this      &size;
        values.resize(size);
        for (T &value : values)
          *this &value;
      }

      void
      take(std::vector<bool> &values)
      {
        std::string text(values.begin(), values.end());
        *this      &text;
        values.assign(text.begin(), text.end());
      }

      void
      take(std::string &text)
      {
        std::size_t size = text.size();
        *this      &size;
        text.resize(size);
        derived().move(text.data(), size);
      }

      template <typename T>
      void
      take(std::shared_ptr<const T> &pointer)
      {
        derived().share(pointer);
      }
    };



    class Writer : public Archive<Writer, false>
    {
    public:
      explicit Writer(SavedState &state)
        : state(state)
        , next(state.bytes.data())
        , end(next + state.bytes.size())
      {}

      void
      move(const void *const from, const std::size_t n)
      {
        if (n > 0)
          std::memcpy(room(n), from, n);
      }

      /** All of an object of nothing but numbers and matrices of fixed size, at
       *  once. */
      template <class T>
      void
      copy(const T &plain)
      {
        static_assert(is_plain<T>);
        new (room(sizeof(T), alignof(T))) T(plain);
      }

      template <typename T>
      void
      share(const std::shared_ptr<const T> &pointer)
      {
        state.shared.push_back(pointer);
      }

    private:
      char *
      room(const std::size_t n, const std::size_t alignment = 1)
      {
        const std::size_t n_used = next - state.bytes.data(),
                          first  = aligned(n_used, alignment);
        if (std::size_t(end - next) < first - n_used + n)
          {
            state.bytes.resize(2 * (first + n));
            next = state.bytes.data() + n_used;
            end  = state.bytes.data() + state.bytes.size();
          }
        char *const begin = next + (first - n_used);
        next              = begin + n;
        return begin;
      }

      SavedState &state;
      char       *next, *end;
    };



    class Reader : public Archive<Reader, true>
    {
    public:
      explicit Reader(const SavedState &state)
        : begin(state.bytes.data())
        , next_shared(state.shared.data())
      {}

      void
      move(void *const to, const std::size_t n)
      {
        if (n > 0)
          std::memcpy(to, begin + n_read, n);
        n_read += n;
      }

      template <class T>
      void
      copy(T &plain)
      {
        n_read = aligned(n_read, alignof(T));
        plain  = *reinterpret_cast<const T *>(begin + n_read);
        n_read += sizeof(T);
      }

      template <typename T>
      void
      share(std::shared_ptr<const T> &pointer)
      {
        pointer = std::static_pointer_cast<const T>(*next_shared++);
      }

    private:
      const char *const                  begin;
      std::size_t                        n_read = 0;
      const std::shared_ptr<const void> *next_shared;
    };

    template <class T>
    static constexpr bool is_plain = std::is_trivially_destructible_v<T> &&
                                     alignof(T) <= alignof(std::max_align_t);

    /** @p n, or the next multiple of a power of 2. */
    static std::size_t
    aligned(const std::size_t n, const std::size_t alignment)
    {
      return (n + alignment - 1) & ~(alignment - 1);
    }

    std::vector<char>                        bytes; ///< or more than there are
    std::vector<std::shared_ptr<const void>> shared;
  };
} // namespace Debond
#endif
