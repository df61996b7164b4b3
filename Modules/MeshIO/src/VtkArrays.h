#pragma once

#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkType.h>

#include <cstddef>
#include <string>

namespace sinew {

/// A VTK array on memory that it neither owns nor changes.
template <class Array, class T>
vtkSmartPointer<Array> wrapArray(const char* name, const T* data, std::size_t values, int components) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  constexpr int keepMemory = 1;
  array->SetArray(const_cast<T*>(data), static_cast<vtkIdType>(values), keepMemory);
  return array;
}

template <class Texts>
vtkSmartPointer<vtkStringArray> textArray(const char* name, const Texts& texts) {
  const auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (const std::string& text : texts) array->InsertNextValue(text);
  return array;
}

}  // namespace sinew
