// A matrix to which rows and columns are appended, with room kept in reserve so
// that growing it one by one does not copy it each time.

#ifndef morph_growingMatrix_hpp
#define morph_growingMatrix_hpp

#include "arrays.hpp"

#include <algorithm>

namespace morph
{

class GrowingMatrix
{
public:

    Index rows() const { return rows_; }

    Index cols() const { return cols_; }

    auto view() { return store_.topLeftCorner(rows_, cols_); }

    auto view() const { return store_.topLeftCorner(rows_, cols_); }

    // What is added is not initialised
    void grow(Index rows, Index cols)
    {
        const auto room = [](Index needed, Index there)
        {
            return
                needed <= there ? there
              : std::max(needed, there + there/16 + 16);
        };
        store_.conservativeResize
        (
            room(rows, store_.rows()),
            room(cols, store_.cols())
        );
        rows_ = rows;
        cols_ = cols;
    }

private:

    Matrix store_ = Matrix(0, 0);
    Index rows_ = 0;
    Index cols_ = 0;
};

} // namespace morph

#endif
