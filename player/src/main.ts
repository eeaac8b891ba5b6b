import "./ui/style/base.css";
import "./ui/style/layout.css";
import "./ui/style/dock.css";
import "./ui/style/panel.css";
import "./ui/style/graph.css";
import { open } from "./ui/opening";

open(document.getElementById("player")!);
