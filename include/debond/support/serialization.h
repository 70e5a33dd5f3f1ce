#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Debond
{
  /**
   * The state of objects as bytes, and back. Classes have a member
   *
   *     template <class Archive> void serialize(Archive &, unsigned int),
   *
   * which holds the accepted state: all that steers later arithmetic, and
   * nothing that the scene gives again. Floating point numbers keep every bit.
   *
   * Bytes of a checkpoint, or of a state @p in_memory: a SavedState. An archive
   * that @p loads throws std::length_error where the bytes are those of other
   * members.
   */
  template <bool loads, bool in_memory>
  class Archive
  {
  public:
    using is_loading                     = std::bool_constant<loads>;
    static constexpr bool has_short_life = in_memory;

    using Bytes  = std::conditional_t<loads, const std::string, std::string>;
    using Shared = std::vector<std::shared_ptr<const void>>;

    /** @p shared: of an archive in memory, what is not copied. */
    explicit Archive(Bytes &bytes, Shared *const shared = nullptr)
      : bytes(bytes)
      , shared(shared)
    {}

    template <typename T>
    Archive &
    operator&(T &value)
    {
      if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
        move(&value, sizeof(T));
      else
        take(value);
      return *this;
    }

    /** All of an object of nothing but numbers and matrices of fixed size, at
     *  once. */
    template <class T>
    void
    copy(T &plain)
    {
      static_assert(std::is_trivially_destructible_v<T>);
      move(&plain, sizeof(T));
    }

  private:
    void
    move(void *const data, const std::size_t n)
    {
      char *const values = static_cast<char *>(data);
      if constexpr (!loads)
        bytes.append(values, n);
      else if (bytes.copy(values, n, n_read) < n)
        throw std::length_error("an archive ends too early");
      n_read += n;
    }

    /** Of what takes a byte or more for each of its items. */
    template <typename Size>
    Size
    size_of(Size size)
    {
      move(&size, sizeof(size));
      if (loads && std::size_t(size) > bytes.size())
        throw std::length_error("an archive holds a size that is none");
      return size;
    }

    template <class T>
    void
    take(T &object)
    {
      object.serialize(*this, 0);
    }

    template <typename T, int R, int C, int O, int MR, int MC>
    void
    take(Eigen::Matrix<T, R, C, O, MR, MC> &matrix)
    {
      if constexpr (R == Eigen::Dynamic || C == Eigen::Dynamic)
        {
          const auto rows    = size_of(matrix.rows()),
                     columns = size_of(matrix.cols());
          matrix.resize(rows, columns);
        }
      move(matrix.data(), matrix.size() * sizeof(T));
    }

    template <typename T, std::size_t n>
    void
    take(std::array<T, n> &values)
    {
      for (T &value : values)
        *this &value;
    }

    template <typename First, typename Second>
    void
    take(std::pair<First, Second> &pair)
    {
      *this &pair.first &pair.second;
    }

    template <typename T>
    void
    take(std::vector<T> &values)
    {
      values.resize(size_of(values.size()));
      for (T &value : values)
        *this &value;
    }

    void
    take(std::string &text)
    {
      text.resize(size_of(text.size()));
      move(text.data(), text.size());
    }

    /** @p Items: a list of what is in the container. */
    template <class Items, class Container>
    void
    take_as(Container &container)
    {
      Items items(container.begin(), container.end());
      take(items);
      container = Container(items.begin(), items.end());
    }

    void
    take(std::vector<bool> &values)
    {
      take_as<std::string>(values);
    }

    template <typename Key, typename T>
    void
    take(std::map<Key, T> &values)
    {
      take_as<std::vector<std::pair<Key, T>>>(values);
    }

    template <typename T>
    void
    take(std::shared_ptr<const T> &pointer)
    {
      static_assert(in_memory);
      if constexpr (loads)
        pointer = std::static_pointer_cast<const T>((*shared)[n_shared++]);
      else
        shared->push_back(pointer);
    }

    Bytes        &bytes;
    Shared *const shared;
    std::size_t   n_read = 0, n_shared = 0;
  };

  /** Those of a checkpoint. */
  using SavingArchive  = Archive<false, false>;
  using LoadingArchive = Archive<true, false>;

  /** For a serialize() that puts more or less into memory than into a
   *  checkpoint. */
  template <class SomeArchive>
  constexpr bool is_in_memory = SomeArchive::has_short_life;



  /** The state of an object, to go back to: what its serialize() puts into a
   *  checkpoint, but in memory. It costs little more than a copy of the
   *  numbers, and what is shared is not copied. */
  class SavedState
  {
  public:
    /** Takes the place of what was saved before, whose memory it uses. */
    template <class Object>
    void
    save(Object &object)
    {
      bytes.clear();
      shared.clear();
      Archive<false, true>(bytes, &shared) & object;
    }

    /** Brings back the same object. */
    template <class Object>
    void
    restore(Object &object)
    {
      Archive<true, true>(bytes, &shared) & object;
    }

  private:
    std::string                              bytes;
    std::vector<std::shared_ptr<const void>> shared;
  };
} // namespace Debond
