#!/usr/bin/env python3
"""Writes the damaged meshes of this folder: python3 generate.py

Two sound meshes of two quadrilaterals with groups (MSH 4.1 and 2.2, ASCII and binary) are built from one list of
numbers; each damaged file is one of them with one thing wrong, named by the file. expected.txt holds the
message for each of them, each checked by eye (the test compares, it does not write); files that begin with
"ok_" are unusual but sound.
"""

import struct
from pathlib import Path

HERE = Path(__file__).parent

V41 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "left edge"
2 10 "plate"
$EndPhysicalNames
$Entities
0 1 1 0
1 0 0 0 0 1 0 2 -1 5 0
1 0 0 0 2 1 0 1 10 1 1
$EndEntities
$Nodes
2 6 1 6
1 1 0 2
1
2
0 0 0
0 1 0
2 1 0 4
3
4
5
6
1 0 0
1 1 0
2 0 0
2 1 0
$EndNodes
$Elements
2 3 1 3
1 1 1 1
1 1 2
2 1 3 2
2 1 3 4 2
3 3 5 6 4
$EndElements
"""

V22 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "left edge"
2 10 "plate"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 0 1 0
3 1 0 0
4 1 1 0
5 2 0 0
6 2 1 0
$EndNodes
$Elements
3
1 1 2 1 1 1 2
2 3 2 10 1 1 3 4 2
3 3 2 10 1 3 5 6 4
$EndElements
"""

POINTS = [(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (2, 0, 0), (2, 1, 0)]
NAMES = V41[V41.index("$PhysicalNames") : V41.index("$Entities")].encode()


def binary_v41(order="<"):
    def ints(*values):
        return struct.pack(f"{order}{len(values)}i", *values)

    def sizes(*values):
        return struct.pack(f"{order}{len(values)}Q", *values)

    def doubles(*values):
        return struct.pack(f"{order}{len(values)}d", *values)

    out = b"$MeshFormat\n4.1 1 8\n" + ints(1) + b"\n$EndMeshFormat\n" + NAMES + b"$Entities\n"
    out += sizes(0, 1, 1, 0)
    out += ints(1) + doubles(0, 0, 0, 0, 1, 0) + sizes(2) + ints(-1, 5) + sizes(0)
    out += ints(1) + doubles(0, 0, 0, 2, 1, 0) + sizes(1) + ints(10) + sizes(1) + ints(1)
    out += b"\n$EndEntities\n$Nodes\n" + sizes(2, 6, 1, 6)
    for dimension, tags in ((1, (1, 2)), (2, (3, 4, 5, 6))):
        out += ints(dimension, 1, 0) + sizes(len(tags)) + sizes(*tags)
        for tag in tags:
            out += doubles(*POINTS[tag - 1])
    out += b"\n$EndNodes\n$Elements\n" + sizes(2, 3, 1, 3)
    out += ints(1, 1, 1) + sizes(1, 1, 1, 2)
    out += ints(2, 1, 3) + sizes(2, 2, 1, 3, 4, 2, 3, 3, 5, 6, 4)
    return out + b"\n$EndElements\n"


def binary_v22(order="<"):
    def ints(*values):
        return struct.pack(f"{order}{len(values)}i", *values)

    out = b"$MeshFormat\n2.2 1 8\n" + ints(1) + b"\n$EndMeshFormat\n" + NAMES + b"$Nodes\n6\n"
    for tag, point in enumerate(POINTS, 1):
        out += ints(tag) + struct.pack(f"{order}3d", *point)
    out += b"\n$EndNodes\n$Elements\n3\n"
    out += ints(1, 1, 2, 1, 1, 1, 1, 2)
    out += ints(3, 2, 2, 2, 10, 1, 1, 3, 4, 2, 3, 10, 1, 3, 5, 6, 4)
    return out + b"\n$EndElements\n"


def write(name, content):
    data = content.encode() if isinstance(content, str) else content
    (HERE / f"{name}.msh").write_bytes(data)


def replaced(name, base, old, new):
    """The base with the first occurrence of one text replaced."""
    if isinstance(base, str):
        base, old, new = base.encode(), old.encode(), new if isinstance(new, bytes) else new.encode()
    assert base.count(old) >= 1, (name, old)
    write(name, base.replace(old, new, 1))


def cut(name, base, before):
    """The base up to a text."""
    before = before.encode() if isinstance(base, str) else before
    base = base.encode() if isinstance(base, str) else base
    write(name, base[: base.index(before)])


def main():
    b41, b22 = binary_v41(), binary_v22()
    size, int4 = (lambda n: struct.pack("<Q", n)), (lambda n: struct.pack("<i", n))

    write("empty", "")
    write("zero_bytes", bytes(300))
    write("text", "Dear reader,\nthis is no mesh.\n")
    write("stl", "solid cube\nfacet normal 0 0 1\n")
    write("png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")

    # header
    replaced("version_4_0", V41, "4.1 0 8", "4.0 0 8")
    replaced("version_2_1", V41, "4.1 0 8", "2.1 0 8")
    replaced("version_text", V41, "4.1 0 8", "four 0 8")
    write("version_1_0", "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 15 1 1 1 1\n$ENDELM\n")
    replaced("file_type", V41, "4.1 0 8", "4.1 2 8")
    replaced("size_16", V41, "4.1 0 8", "4.1 0 16")
    replaced("v22_size_4", V22, "2.2 0 8", "2.2 0 4")
    replaced("binary_flag_on_ascii", V41, "4.1 0 8", "4.1 1 8")
    replaced("ascii_flag_on_binary", b41, b"4.1 1 8", b"4.1 0 8")
    replaced("endianness_garbled", b41, int4(1) + b"\n$End", int4(77) + b"\n$End")
    write("endianness_wrong_v41", binary_v41("<").replace(int4(1) + b"\n$End", b"\0\0\0\1\n$End", 1))
    write("endianness_wrong_v22", binary_v22("<").replace(int4(1) + b"\n$End", b"\0\0\0\1\n$End", 1))
    replaced("v41_as_v22", V41, "4.1 0 8", "2.2 0 8")
    replaced("v22_as_v41", V22, "2.2 0 8", "4.1 0 8")
    cut("cut_in_header", V41, " 0 8")

    # names
    replaced("name_not_utf8", V41, "left edge", b"left \xff\xfe edge")
    replaced("name_open", V41, '"plate"', '"plate')
    replaced("name_without_quotes", V41, '"plate"', "plate")
    replaced("name_twice", V41, '2 10 "plate"', '1 1 "plate"')
    replaced("name_dimension", V41, '2 10 "plate"', '4 10 "plate"')
    replaced("names_huge", V41, 'Names\n2\n', "Names\n1000000000000000000\n")
    replaced("names_too_few", V41, 'Names\n2\n', "Names\n3\n")
    cut("cut_in_names", V41, '2 10 "plate"')

    # entities
    replaced("entities_negative", V41, "0 1 1 0\n", "0 -1 1 0\n")
    replaced("entities_huge", V41, "0 1 1 0\n", "0 9223372036854775808 1 0\n")
    replaced("entity_tag_overflow", V41, "1 0 0 0 2 1 0", "99999999999 0 0 0 2 1 0")
    replaced("entity_nan", V41, "1 0 0 0 2 1 0", "1 0 0 0 nan 1 0")
    replaced("entity_physical_huge", b41, size(2) + int4(-1), size(2**63) + int4(-1))
    cut("cut_in_entities", V41, "1 10 1 1")
    cut("cut_in_entities_binary", b41, size(1) + int4(10))

    # nodes
    for text in ("nan", "inf", "1e999"):
        replaced(f"node_{text}", V41, "2 0 0\n2 1 0", f"2 {text} 0\n2 1 0")
    replaced("v22_node_nan", V22, "5 2 0 0", "5 2 NaN 0")
    replaced("node_nan_binary", b41, struct.pack("<3d", 2, 0, 0), struct.pack("<3d", 2, float("nan"), 0))
    replaced("v22_node_inf_binary", b22, struct.pack("<3d", 2, 0, 0), struct.pack("<3d", 2, float("inf"), 0))
    replaced("node_comma", V41, "2 0 0\n2 1 0", "2 0,5 0\n2 1 0")
    replaced("node_twice", V41, "\n3\n4\n5\n6\n", "\n3\n4\n3\n6\n")
    replaced("node_zero", V41, "\n3\n4\n5\n6\n", "\n3\n4\n0\n6\n")
    replaced("node_twice_binary", b41, size(3) + size(4) + size(5), size(3) + size(4) + size(3))
    replaced("v22_node_twice", V22, "5 2 0 0", "4 2 0 0")
    replaced("v22_node_negative", V22, "5 2 0 0", "-5 2 0 0")
    replaced("v22_node_overflow", V22, "5 2 0 0", "5000000000 2 0 0")
    replaced("nodes_huge", V41, "2 6 1 6", "2 9223372036854775808 1 6")
    replaced("nodes_beyond_u64", V41, "2 6 1 6", "2 99999999999999999999 1 6")
    replaced("node_blocks_huge", V41, "2 6 1 6", "1000000000000000000 6 1 6")
    replaced("node_block_huge", V41, "2 1 0 4", "2 1 0 1000000000000000000")
    replaced("node_block_short", V41, "2 1 0 4", "2 1 0 3")
    replaced("node_block_long", V41, "2 1 0 4", "2 1 0 5")
    replaced("nodes_more_announced", V41, "2 6 1 6", "2 7 1 6")
    replaced("node_range_reversed", V41, "2 6 1 6", "2 6 6 1")
    replaced("nodes_huge_binary", b41, b"$Nodes\n" + size(2) + size(6), b"$Nodes\n" + size(2) + size(2**63))
    replaced("v22_nodes_huge", V22, "Nodes\n6\n", "Nodes\n1000000000000000000\n")
    replaced("v22_nodes_negative", V22, "Nodes\n6\n", "Nodes\n-6\n")
    replaced("v22_nodes_too_many", V22, "Nodes\n6\n", "Nodes\n5\n")
    replaced("v22_nodes_huge_binary", b22, b"Nodes\n6\n", b"Nodes\n600000\n")
    replaced("parametric", V41, "2 1 0 4", "2 1 1 4")
    replaced("v22_parametric", V22, "$Nodes", "$ParametricNodes")
    replaced("node_dimension", V41, "2 1 0 4", "7 1 0 4")
    replaced("end_nodes_missing", V41, "$EndNodes\n", "")
    replaced("no_nodes_section", V41, V41[V41.index("$Nodes") : V41.index("$Elements")], "")
    write("nodes_repeated", V41 + V41[V41.index("$Nodes") : V41.index("$Elements")])
    cut("cut_in_node_tags", V41, "5\n6\n1 0 0")
    cut("cut_in_coordinates", V41, "2 1 0\n$EndNodes")
    cut("cut_in_end_nodes", V41, "Nodes\n$Elements")
    cut("cut_in_coordinates_binary", b41, struct.pack("<3d", 2, 0, 0)[4:])
    cut("v22_cut_in_nodes", V22, "0\n6 2 1 0")
    cut("v22_cut_in_nodes_binary", b22, struct.pack("<3d", 2, 0, 0)[4:])

    # elements
    replaced("element_twice", V41, "3 3 5 6 4", "2 3 5 6 4")
    replaced("element_zero", V41, "3 3 5 6 4", "0 3 5 6 4")
    replaced("element_dangling", V41, "3 3 5 6 4", "3 3 5 7 4")
    replaced("element_dangling_binary", b41, size(3) + size(3) + size(5), size(3) + size(3) + size(500))
    replaced("element_node_twice", V41, "3 3 5 6 4", "3 3 5 3 4")
    replaced("element_type_zero", V41, "2 1 3 2\n", "2 1 0 2\n")
    replaced("element_quad16", V41, "2 1 3 2\n", "2 1 36 2\n")
    replaced("element_tet20", V41, "2 1 3 2\n", "3 1 29 2\n")
    replaced("element_wrong_dimension", V41, "2 1 3 2\n", "1 1 3 2\n")
    replaced("elements_huge", V41, "2 3 1 3", "2 18446744073709551615 1 3")
    replaced("elements_more_announced", V41, "2 3 1 3", "2 4 1 4")
    replaced("element_block_missing", V41, "2 3 1 3", "3 3 1 3")
    replaced("element_block_huge", V41, "2 1 3 2\n", "2 1 3 4000000000\n")
    replaced("element_block_short", V41, "2 1 3 2\n", "2 1 3 1\n")
    replaced("v22_element_twice", V22, "3 3 2 10", "2 3 2 10")
    replaced("v22_element_type_zero", V22, "3 3 2 10", "3 0 2 10")
    replaced("v22_element_tags_negative", V22, "3 3 2 10", "3 3 -2 10")
    replaced("v22_element_tags_huge", V22, "3 3 2 10", "3 3 2000000000 10")
    replaced("v22_element_physical_overflow", V22, "3 3 2 10", "3 3 2 3000000000")
    replaced("v22_element_dangling", V22, "3 5 6 4", "3 5 9 4")
    replaced("v22_element_node_twice", V22, "3 5 6 4", "3 5 5 4")
    replaced("v22_element_short_line", V22, "1 3 5 6 4", "1 3 5 6")
    replaced("v22_elements_negative", V22, "Elements\n3\n", "Elements\n-3\n")
    replaced("v22_elements_huge", V22, "Elements\n3\n", "Elements\n9223372036854775808\n")
    replaced("v22_elements_too_few", V22, "Elements\n3\n", "Elements\n2\n")
    replaced("v22_block_zero_binary", b22, int4(3) + int4(2) + int4(2), int4(3) + int4(0) + int4(2))
    replaced("v22_block_too_long_binary", b22, int4(3) + int4(2) + int4(2), int4(3) + int4(9) + int4(2))
    replaced("v22_tags_negative_binary", b22, int4(3) + int4(2) + int4(2), int4(3) + int4(2) + int4(-2))
    replaced("v22_element_type_binary", b22, int4(3) + int4(2) + int4(2), int4(99) + int4(2) + int4(2))
    replaced("v22_dangling_binary", b22, int4(5) + int4(6) + int4(4), int4(5) + int4(-6) + int4(4))
    replaced("no_elements", V41, V41[V41.index("2 3 1 3") : V41.index("$EndElements")], "0 0 0 0\n")
    replaced("v22_no_elements", V22, V22[V22.index("3\n1 1 2") : V22.index("$EndElements")], "0\n")
    cut("no_elements_section", V41, "$Elements")
    cut("cut_in_element", V41, "6 4\n$EndElements")
    cut("cut_in_element_binary", b41, size(6) + size(4) + b"\n")
    cut("v22_cut_in_element", V22, "6 4\n$EndElements")
    cut("v22_cut_in_element_binary", b22, int4(6) + int4(4) + b"\n")
    cut("cut_before_end", V41, "$EndElements")

    # sections
    write("garbage_after_end", V41 + "and so on\n")
    write("garbage_after_end_binary", b41 + b"\x07\x00\x00")
    write("dollar_alone", V41 + "$\n")
    write("section_open", V41 + "$Periodic\n0\n")
    replaced("elements_before_nodes", V41, "$Nodes", V41[V41.index("$Elements") :] + "$Nodes")
    replaced("partitioned", V41, "$Nodes", "$PartitionedEntities\n2\n0\n$EndPartitionedEntities\n$Nodes")
    replaced("end_name_wrong", V41, "$EndElements", "$EndElement")
    replaced("byte_flipped", V41, "2 1 3 4 2\n3", "2 1 \xb3 4 2\n3")

    # unusual, but sound
    write("ok_crlf", V41.replace("\n", "\r\n"))
    write("ok_v22_crlf", V22.replace("\n", "\r\n"))
    write("ok_no_last_line_end", V41.rstrip())
    replaced("ok_form_feed", V41, "0 1 1 0\n", "\f0 1 1\f0\n")
    write("ok_big_endian", binary_v41(">"))
    write("ok_v22_big_endian", binary_v22(">"))
    write("ok_binary", b41)
    write("ok_v22_binary", b22)
    write("ok_comments_first", "$Comments\n$Nodes\n$EndComments\n" + V41)
    write("ok_unknown_section", V22 + "$Periodic\n0\n$EndPeriodic\n$My_Data\n7\n$EndMy_Data\n")


if __name__ == "__main__":
    main()
