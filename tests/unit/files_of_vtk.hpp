// SPDX-License-Identifier: BSD-3-Clause
// A square of two quadrilaterals as VTK's own writer writes it: as text, with inline data, and with
// appended data. Inline and appended data are compressed by zlib.
#pragma once
#include <string>

namespace meniscus::test {

inline const std::string vtk_ascii = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <UnstructuredGrid>
    <Piece NumberOfPoints="6" NumberOfCells="2">
      <PointData>
        <DataArray type="Float64" Name="q" NumberOfComponents="3" format="ascii" RangeMin="0" RangeMax="12.24744871391589">
          0 0 0 1 2 -1
          2 4 -2 3 6 -3
          4 8 -4 5 10 -5
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
            <Value index="1">
              12.247448714
            </Value>
          </InformationKey>
        </DataArray>
      </PointData>
      <CellData>
      </CellData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii" RangeMin="0" RangeMax="2.23606797749979">
          0 0 0 1 0 0
          2 0 0 0 1 0
          1 1 0 2 1 0
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
            <Value index="1">
              2.2360679775
            </Value>
          </InformationKey>
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="ascii" RangeMin="0" RangeMax="5">
          0 1 4 3 1 2
          5 4
        </DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii" RangeMin="4" RangeMax="8">
          4 8
        </DataArray>
        <DataArray type="UInt8" Name="types" format="ascii" RangeMin="9" RangeMax="9">
          9 9
        </DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

inline const std::string vtk_binary = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <UnstructuredGrid>
    <Piece NumberOfPoints="6" NumberOfCells="2">
      <PointData>
        <DataArray type="Float64" Name="q" NumberOfComponents="3" format="binary" RangeMin="0" RangeMax="12.24744871391589">
          AQAAAACAAACQAAAAMQAAAA==eJxjYMAHPthDGQ5Q/n5UvgCUZjgAoTigfAkozXEAVZ0CTB9UXATKV4HSIgcAMIQI4w==
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
            <Value index="1">
              12.247448714
            </Value>
          </InformationKey>
        </DataArray>
      </PointData>
      <CellData>
      </CellData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="binary" RangeMin="0" RangeMax="2.23606797749979">
          AQAAAACAAABIAAAAGgAAAA==eJxjYEAGDfZIHAcGrHIgGq7OAcYGAHCHBDw=
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
            <Value index="1">
              2.2360679775
            </Value>
          </InformationKey>
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="binary" RangeMin="0" RangeMax="5">
          AQAAAACAAABAAAAAGQAAAA==eJxjYIAARijNAqWZ0cSZoDQrmjoAAnAAFQ==
        </DataArray>
        <DataArray type="Int64" Name="offsets" format="binary" RangeMin="4" RangeMax="8">
          AQAAAACAAAAQAAAADgAAAA==eJxjYYAADigNAACQAA0=
        </DataArray>
        <DataArray type="UInt8" Name="types" format="binary" RangeMin="9" RangeMax="9">
          AQAAAACAAAACAAAACgAAAA==eJzj5AQAAB0AEw==
        </DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

inline const std::string vtk_appended = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <UnstructuredGrid>
    <Piece NumberOfPoints="6"                    NumberOfCells="2"                   >
      <PointData>
        <DataArray type="Float64" Name="q" NumberOfComponents="3" format="appended" RangeMin="0"                    RangeMax="12.247448714"         offset="0"                   >
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
            <Value index="1">
              12.247448714
            </Value>
          </InformationKey>
        </DataArray>
      </PointData>
      <CellData>
      </CellData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="appended" RangeMin="0"                    RangeMax="2.2360679775"         offset="92"                  >
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
            <Value index="1">
              2.2360679775
            </Value>
          </InformationKey>
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="appended" RangeMin=""                     RangeMax=""                     offset="152"                 />
        <DataArray type="Int64" Name="offsets" format="appended" RangeMin=""                     RangeMax=""                     offset="212"                 />
        <DataArray type="UInt8" Name="types" format="appended" RangeMin=""                     RangeMax=""                     offset="256"                 >
        </DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
  <AppendedData encoding="base64">
   _AQAAAACAAACQAAAAMQAAAA==eJxjYMAHPthDGQ5Q/n5UvgCUZjgAoTigfAkozXEAVZ0CTB9UXATKV4HSIgcAMIQI4w==AQAAAACAAABIAAAAGgAAAA==eJxjYEAGDfZIHAcGrHIgGq7OAcYGAHCHBDw=AQAAAACAAABAAAAAGQAAAA==eJxjYIAARijNAqWZ0cSZoDQrmjoAAnAAFQ==AQAAAACAAAAQAAAADgAAAA==eJxjYYAADigNAACQAA0=AQAAAACAAAACAAAACgAAAA==eJzj5AQAAB0AEw==
  </AppendedData>
</VTKFile>
)";

}  // namespace meniscus::test
