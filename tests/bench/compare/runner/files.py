"""The files that the peers need: a topology of two devices, their certificates, and the message set."""
import random
import shutil
import socket
import subprocess

DEVICES = (("near", "0xe000fe08"), ("far", "0xe000fe09"))


def free_port():
    """Below the range from which connections get their own ports; what the peers use beside it is free as well."""
    while True:
        port = random.randrange(12000, 32000, 20)
        try:
            for place in (0, 1, 10):
                with socket.create_server(("127.0.0.1", port + place)):
                    pass
            return port
        except OSError:
            continue


PORTS = (free_port(), free_port())  # of the first and the second pair of ends


def topology(mode, hosts, pair):
    lines = ['<topology xmlns="urn:liena:topology:1" name="comparison" version="1.0">', f'  <security mode="{mode}"/>']
    for index, (name, number) in enumerate(DEVICES):
        lines.append(f'  <device name="{name}" id="{number}" message-set="comparison" host="{hosts[index]}" port="{PORTS[pair] + 10 * index}"/>')
    return "\n".join(lines + ['  <link between="near far"/>', "</topology>", ""])


def write(folder, mode, hosts, pair, set_file, tool):
    """Makes `folder` as the option --files of the peers wants it."""
    (folder / "sets").mkdir(parents=True)
    for name, _ in DEVICES:
        (folder / f"store-{name}").mkdir()
    shutil.copy(set_file, folder / "sets")
    (folder / "topology.xml").write_text(topology(mode, hosts, pair))
    pki = str(folder / "pki")
    for command in (["init", "--dir", pki, "--site", "comparison"], ["issue", "--dir", pki, "--topology", str(folder / "topology.xml")]):
        subprocess.run([str(tool), "pki", *command], check=True, stdout=subprocess.DEVNULL)
    return folder
