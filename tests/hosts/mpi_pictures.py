# SPDX-License-Identifier: MIT
"""Reads an .xmf file as ParaView does, and prints each array that it names: file, path, kind and bytes of a number, sizes."""
import sys
import xml.etree.ElementTree as tree

root = tree.parse(sys.argv[1]).getroot()
grid = root.find("Domain/Grid")
count = int(grid.find("Topology").get("NumberOfElements"))
assert root.tag == "Xdmf" and grid.get("GridType") == "Uniform"
assert grid.find("Topology").get("TopologyType") == "Polyvertex"
assert float(grid.find("Time").get("Value")) > 0
assert len(grid.findall("Geometry")) == 1 and grid.find("Geometry").get("GeometryType") == "XYZ"
names = [a.get("Name") for a in grid.findall("Attribute")]
assert len(set(names)) == len(names) >= 4, names
for part in grid.findall("Geometry") + grid.findall("Attribute"):
    item = part.find("DataItem")
    sizes = [int(s) for s in item.get("Dimensions").split()]
    vector = part.tag == "Geometry" or part.get("AttributeType") == "Vector"
    assert part.tag == "Geometry" or (part.get("Center") == "Node" and part.get("AttributeType") in ("Vector", "Scalar"))
    assert item.get("Format") == "HDF" and sizes == ([count, 3] if vector else [count]), sizes
    file, path = item.text.strip().split(":")
    print(file, path, item.get("NumberType"), item.get("Precision"), *sizes)
