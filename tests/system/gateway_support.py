"""What tests of the console's gateway share: its process, and one without lianad."""
import pathlib
import subprocess
import tempfile

from support import SystemTest
from liana.system import program


class Gateway:
    """liana-gateway for one test, on a free port unless another is given."""

    def __init__(self, test, api, *words, listen="127.0.0.1:0"):
        self.log_file = tempfile.NamedTemporaryFile("r", prefix="liana-gateway-", suffix=".log")
        test.addCleanup(self.log_file.close)
        with open(self.log_file.name, "ab") as log:
            call = [program("liana-gateway"), "--api", str(api), "--listen", listen, *map(str, words)]
            self.process = subprocess.Popen(call, stdout=subprocess.PIPE, stderr=log, text=True)
        test.addCleanup(self.process.stdout.close)
        test.addCleanup(self.end)
        self.address = self.process.stdout.readline().strip()

    def end(self):
        self.process.kill()
        self.process.wait()

    def log(self):
        return pathlib.Path(self.log_file.name).read_text()

    def resident_kB(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0])


class GatewayAloneTest(SystemTest):
    """A gateway without lianad, its tokens and its certificate."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="liana-gateway-")))
        self.api = self.folder / "api"  # nobody listens there
        self.tokens = self.folder / "tokens"
        self.write_tokens("anna operate operates-the-arm-0001\nwill watch watches-the-arm-00002\n")

    def write_tokens(self, text, mode=0o600):
        self.tokens.write_text(text)
        self.tokens.chmod(mode)

    def certificate(self):
        """A certificate that nobody has signed, and its key: words for the gateway."""
        names = [self.folder / "cert.pem", self.folder / "key.pem"]
        call = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes"]
        call += ["-subj", "/CN=localhost", "-days", "2", "-out", names[0], "-keyout", names[1]]
        subprocess.run(call, check=True, capture_output=True)
        return ["--cert", names[0], "--key", names[1]]
