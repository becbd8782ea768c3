return string.find(("a"):rep(4000), ".-.-.-.-.-.-b")
