#include "results/report_parts.h"

namespace stillhook {

std::string report_style() {
  return R"css(
:root{--ink:#1c2329;--muted:#4a5560;--line:#d4dae0;--paper:#fff;--soft:#f4f6f8;--pass:#00603a;--fail:#a4001d;--warn:#7a4b00;--link:#004f8c}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%;scroll-padding-top:1rem}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,"Segoe UI",Helvetica,Arial,sans-serif;font-variant-numeric:tabular-nums}
main,header,footer{max-width:66rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:1.1rem}
#overview{display:grid;grid-template-columns:minmax(0,21rem) minmax(0,1fr);gap:0 1.4rem;align-items:start}
main:has(#overview),header:has(+main>#overview){max-width:80rem}
main:has(#overview)>nav,main:has(#overview)>section:not(#overview){max-width:66rem;margin-left:auto;margin-right:auto}
header:has(+main>#overview) p{max-width:none}
#overview>div{margin-top:.7rem}
.judgement .verdict{margin:0 0 .7rem;padding:.7rem .9rem;font-size:.92rem;overflow-wrap:anywhere}
.judgement .tiles+.verdict{margin-top:.7rem}
.judgement .tiles{grid-template-columns:1fr 1fr;gap:.45rem;margin:0}
.judgement .tile{padding:.4rem .6rem}
.judgement .tile b{font-size:1.2rem}
.judgement .tile .pass,.judgement .tile .fail,.judgement .tile .warn{font-size:.8rem}
.control{display:flex;flex-wrap:wrap;gap:.1rem 1.2rem;margin:.1rem 0 .35rem;font-size:.84rem;line-height:1.4}
.control div{display:flex;gap:.4rem}
.control dt{color:var(--muted)}
.control dd{margin:0;font-weight:600}
.key{display:block;line-height:1.5}
.replay{min-width:0}
h1{font-size:1.45rem;line-height:1.2;margin:0 0 .25rem;letter-spacing:-.01em}
h2{font-size:1.25rem;line-height:1.25;margin:2.5rem 0 .6rem;padding-top:.75rem;border-top:1px solid var(--line)}
h3{font-size:1rem;margin:1.5rem 0 .35rem}
p{margin:.4rem 0;max-width:46rem;overflow-wrap:anywhere}
a{color:var(--link)}
p.asked{white-space:pre-line;max-width:none}
.muted,small{color:var(--muted)}
small{font-size:.84rem}
nav{margin:1rem 0 0;font-size:.9rem}
nav a{display:inline-block;margin:0 1rem .25rem 0}
.verdict{border-left:.5rem solid var(--pass);background:#eef7f2;padding:.9rem 1.1rem;margin:1.1rem 0}
.verdict.fail{border-color:var(--fail);background:#fcf0f1}
.verdict.warn{border-color:#b07000;background:#fdf6e7}
.verdict strong{display:block;font-size:1.35rem;line-height:1.25;color:var(--pass)}
.verdict.fail strong{color:var(--fail)}
.verdict.warn strong{color:var(--warn)}
.verdict.fail,.verdict.warn{color:var(--ink);font-weight:400}
.verdict p{max-width:none}
.tiles{display:grid;grid-template-columns:repeat(auto-fill,minmax(9.2rem,1fr));gap:.6rem;margin:1rem 0;padding:0}
.tile{border:1px solid var(--line);border-radius:4px;padding:.55rem .7rem;min-width:0}
.tile b{display:block;font-size:1.35rem;line-height:1.2;font-weight:650;white-space:nowrap}
.tile b span{font-size:.85rem;font-weight:400;color:var(--muted)}
.tile div{font-size:.84rem;color:var(--muted);line-height:1.3}
.scroll{overflow-x:auto;margin:.5rem 0 1rem}
table{border-collapse:collapse;font-size:.86rem;line-height:1.35;min-width:100%}
th,td{padding:.32rem .55rem;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
thead th{font-weight:600;border-bottom:2px solid #7c8894;vertical-align:bottom}
tbody th{font-weight:500}
td.n,th.n{text-align:right}
td.n{white-space:nowrap}
td.n.wide{white-space:normal}
tr.group th{background:var(--soft);font-weight:600}
.pass{color:var(--pass);font-weight:650}
.fail{color:var(--fail);font-weight:650}
.warn{color:var(--warn);font-weight:650}
td .pass,td .fail,td .warn,td small{white-space:nowrap}
.track{position:relative;display:flex;height:2.1rem;margin-top:1rem;border:1px solid #7c8894;border-radius:3px;overflow:hidden}
.track i{display:flex;align-items:center;justify-content:center;min-width:0;overflow:hidden;font-style:normal;font-size:.84rem;font-weight:600;border-right:1px solid #fff;color:#fff}
.track i:last-child{border-right:0}
.on_barge{background:#5b6672}.transfer{background:#a83a00}.hanging{background:#005c94}.set_down{background:#87357a}.landed{background:#00603a}
.ticks{position:relative;height:1.05rem;font-size:.84rem}
.ticks b{position:absolute;top:0;width:0;border-left:2px solid #111;height:.6rem}
.phases{list-style:none;padding:0;margin:.4rem 0;display:grid;grid-template-columns:repeat(auto-fill,minmax(15.5rem,1fr));gap:.15rem 1.2rem;font-size:.9rem}
.phases li{display:flex;gap:.5rem;align-items:baseline;min-width:0}
.phases li>b{flex:none;min-width:1.5rem;text-align:center;border-radius:3px;color:#fff;font-size:.8rem;padding:.05rem .2rem}
.phases li>span{flex:1;min-width:0}
.phases li>small{white-space:nowrap}
figure{margin:1rem 0;break-inside:avoid}
figure .scroll{margin:0}
svg.plot{display:block;width:100%;min-width:600px;height:auto}
.poses{display:grid;grid-template-columns:repeat(auto-fill,minmax(19rem,1fr));gap:.2rem 1.2rem}
.poses figure{margin:.4rem 0}
svg.pose{display:block;width:100%;height:auto;border:1px solid var(--line)}
svg.range{width:110px;height:14px;vertical-align:middle}
figcaption{font-size:.84rem;color:var(--muted);max-width:46rem}
pre{overflow-x:auto;background:var(--soft);padding:.8rem;font:12.5px/1.45 ui-monospace,Menlo,Consolas,"DejaVu Sans Mono",monospace}
summary{cursor:pointer;font-weight:600;padding:.3rem 0}
ul,ol{padding-left:1.3rem}
li{margin:.2rem 0}
footer{margin-top:2.5rem;padding-top:.8rem;padding-bottom:2rem;border-top:1px solid var(--line);font-size:.84rem;color:var(--muted)}
a:focus-visible,summary:focus-visible,.scroll:focus-visible{outline:3px solid #005c94;outline-offset:2px}
@media(max-width:900px){#overview{display:flex;flex-direction:column;align-items:stretch}.judgement{display:contents}.judgement .verdict{order:-2;margin-top:.7rem}.replay{order:-1}.judgement .tiles{margin-top:1rem}.replay .phases{margin:.2rem 0}}
@media(max-width:480px){main,header,footer{padding-left:.9rem;padding-right:.9rem}h1{font-size:1.35rem}.tiles{grid-template-columns:1fr 1fr}.tile b{font-size:1.15rem}table{min-width:36rem}}
@page{size:A4;margin:18mm 13mm 17mm;font:8pt system-ui,"Segoe UI",Helvetica,Arial,sans-serif;color:#4a5560}
@page{@top-left{text-align:left}@top-right{text-align:right}@bottom-left{text-align:left}@bottom-right{text-align:right}}
@media print{body{font-size:10pt}main,header,footer{max-width:none;padding:0}nav{display:none}.scroll{overflow:visible}table{font-size:7.6pt}th,td{padding:.18rem .3rem}td.n,th.n{white-space:normal}td small,th small{font-size:inherit}.judgement .tiles{grid-template-columns:repeat(5,1fr)}.poses{grid-template-columns:1fr 1fr 1fr}tr,.tile,.verdict,.poses figure{break-inside:avoid}h2,h3{break-after:avoid}svg.plot{min-width:0}p.asked{font-size:8.5pt}thead{display:table-header-group}
.track i,.phases li>b,.verdict,tr.group th,pre{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";
}

}  // namespace stillhook
