// Tells whether data are those that were seen before, in spite of the pipeline's time stamps.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkInformationVector;

namespace smokevis
{

/// Which arrays a data object is made of, and when each was last changed. Equal lists mean equal
/// data: a filter that hands out its former output once more shares the arrays, though its output
/// is newer.
using Identity = std::vector<std::pair<const void*, std::uint64_t>>;
Identity IdentityOf(vtkDataObject* data);

/// A checksum of all that is in a data object, for data that were read or made again: structure,
/// points, cells, arrays with their names, field data and time.
std::uint64_t Fingerprint(vtkDataObject* data);
/// Of all data that are connected to a port, in their order.
std::uint64_t Fingerprint(vtkInformationVector* port);

} // namespace smokevis
