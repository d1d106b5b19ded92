// Numbers the vertices of the parts² small triangles into which a triangle is divided. Vertex (row r, column c) with 0
// ≤ c ≤ r ≤ parts has the index r·(r + 1)/2 + c. Row 0 is the first corner, and the last row is the edge opposite to
// it.

uint verticesPerTriangle(uint parts) { return (parts + 1u) * (parts + 2u) / 2u; }

uint vertexNumber(uvec2 rowAndColumn) { return rowAndColumn.x * (rowAndColumn.x + 1u) / 2u + rowAndColumn.y; }

// Returns the barycentric coordinates of a vertex. On an edge they depend only on the edge, so that neighbouring
// triangles agree.
vec3 weightsOf(uint number, uint parts) {
    uint row = uint((sqrt(8.0 * float(number) + 1.0) - 1.0) * 0.5);
    if (vertexNumber(uvec2(row + 1u, 0u)) <= number) ++row;
    if (vertexNumber(uvec2(row, 0u)) > number) --row;
    uint column = number - vertexNumber(uvec2(row, 0u));
    return vec3(parts - row, row - column, column) / float(parts);
}
