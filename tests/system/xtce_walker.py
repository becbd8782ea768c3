"""Decodes packets by an XTCE file alone: shares no code with what writes that file.

Only what a fixed packet needs: containers with comparisons, integers, floats, enumerations, strings of a fixed size,
absolute times with a scale.
"""
import math
import struct
import xml.etree.ElementTree as ElementTree

SPACE = "{http://www.omg.org/spec/XTCE/20180204}"


def children(element, name):
    return element.findall(SPACE + name)


def only(element, name):
    found = children(element, name)
    if len(found) != 1:
        raise ValueError(f"{element.tag} has {len(found)} {name}")
    return found[0]


class Type:
    """How many bits a value has, and what they mean."""

    def __init__(self, element):
        self.kind = element.tag.removeprefix(SPACE).removesuffix("ParameterType")
        getattr(self, "read_" + self.kind)(element)

    def read_Integer(self, element):
        encoding = only(element, "IntegerDataEncoding")
        assert encoding.get("encoding", "unsigned") == "unsigned"
        self.bits = int(encoding.get("sizeInBits"))
        self.value = lambda raw: raw

    def read_Float(self, element):
        self.bits = int(only(element, "FloatDataEncoding").get("sizeInBits"))
        form = {32: ">f", 64: ">d"}[self.bits]
        self.value = lambda raw: struct.unpack(form, raw.to_bytes(self.bits // 8, "big"))[0]

    def read_Enumerated(self, element):
        self.bits = int(only(element, "IntegerDataEncoding").get("sizeInBits"))
        rows = children(only(element, "EnumerationList"), "Enumeration")
        words = {int(row.get("value")): row.get("label") for row in rows}
        self.value = lambda raw: words[raw]

    def read_String(self, element):
        size = only(only(element, "StringDataEncoding"), "SizeInBits")
        self.bits = int(only(only(size, "Fixed"), "FixedValue").text)
        end = bytes.fromhex(only(size, "TerminationChar").text)
        self.value = lambda raw: raw.to_bytes(self.bits // 8, "big").split(end)[0].decode("utf-8")

    def read_AbsoluteTime(self, element):
        encoding = only(element, "Encoding")
        assert only(only(element, "ReferenceTime"), "Epoch").text == "UNIX"
        scale = float(encoding.get("scale", "1")), float(encoding.get("offset", "0"))
        self.bits = int(only(encoding, "IntegerDataEncoding").get("sizeInBits"))
        self.value = lambda raw: raw * scale[0] + scale[1]


class Container:
    def __init__(self, element):
        self.name, self.is_abstract = element.get("name"), element.get("abstract") == "true"
        self.entries = [entry.get("parameterRef") for entry in only(element, "EntryList")]
        self.base, self.where = None, []
        for base in children(element, "BaseContainer"):
            self.base = base.get("containerRef")
            for row in base.iter(SPACE + "Comparison"):
                assert row.get("comparisonOperator", "==") == "=="
                self.where.append((row.get("parameterRef"), row.get("value")))


class Walker:
    def __init__(self, text):
        root = ElementTree.fromstring(text)
        assert root.tag == SPACE + "SpaceSystem"
        telemetry = only(root, "TelemetryMetaData")
        types = {element.get("name"): Type(element) for element in only(telemetry, "ParameterTypeSet")}
        self.parameters = {
            element.get("name"): types[element.get("parameterTypeRef")] for element in only(telemetry, "ParameterSet")
        }
        self.containers = [Container(element) for element in only(telemetry, "ContainerSet")]

    def decode(self, packet):
        """(name of the container, values by parameter); ValueError when no container fits or bits are left over."""
        whole, left, values = int.from_bytes(packet, "big"), 8 * len(packet), {}
        container = next(each for each in self.containers if each.base is None)
        while True:
            for name in container.entries:
                kind = self.parameters[name]
                left -= kind.bits
                if left < 0:
                    raise ValueError(f"{container.name}: the packet ends before {name}")
                values[name] = kind.value(whole >> left & (1 << kind.bits) - 1)
            if not container.is_abstract:
                break
            container = self.heir(container, values)
        if left:
            raise ValueError(f"{container.name}: {left} bits are left over")
        return container.name, values

    def heir(self, container, values):
        found = [
            each
            for each in self.containers
            if each.base == container.name and all(str(values[name]) == value for name, value in each.where)
        ]
        if len(found) != 1:
            raise ValueError(f"{container.name}: {len(found)} containers fit")
        return found[0]


def same(decoded, said):
    """Whether a decoded value is what the API said; null there is a value that is not known."""
    if said is None:
        return decoded in ("", "not_known") or decoded != decoded or decoded in (2**8 - 1, 2**16 - 1, 2**32 - 1)
    if isinstance(said, bool):
        return decoded == ("true" if said else "false")
    if isinstance(said, float):
        return math.isclose(decoded, said, rel_tol=0.0, abs_tol=0.0)
    return decoded == said
